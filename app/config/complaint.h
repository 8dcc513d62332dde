#pragma once
// The first thing that is wrong with a file, as one line: `file:line: what; expected what`.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "hal/base/result.h"

namespace dottrack::config {

// Readers complain and read on with defaults; the owner asks once, at the end. Later complaints
// are usually consequences of the first one and are dropped.
class Complaint {
 public:
  explicit Complaint(std::string file) : file_(std::move(file)) {}

  // Line 0: the file as a whole.
  void add(std::size_t line, std::string_view what, std::string_view expected);
  // A complaint that another file's reader has worded already.
  void add(Error error);

  bool empty() const { return !first_.has_value(); }
  const Error& first() const { return *first_; }  // only when not empty

 private:
  std::string file_;
  std::optional<Error> first_;
};

// The text in double quotes, control characters replaced: a message stays on its line.
std::string in_quotes(std::string_view text);

// The shortest text that reads back as the same number.
std::string shortest(double number);

}  // namespace dottrack::config
