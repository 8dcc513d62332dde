#pragma once
// What report files are made of.

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dottrack::workstation {

// In quotes, with what must not stand there escaped.
std::string json_string(std::string_view text);

// An object whose members come in the order in which they are added.
class JsonObject {
 public:
  // `depth`: of the objects around it.
  explicit JsonObject(int depth) : indent_(static_cast<std::size_t>(2 * depth), ' ') {}

  // A value is JSON already, unless it is a number.
  template <class T>
  void add(std::string_view key, const T& value) {
    members_.push_back(fmt::format("{}  {}: {}", indent_, json_string(key), value));
  }
  std::string text() const {
    return members_.empty() ? "{}"
                            : fmt::format("{{\n{}\n{}}}", fmt::join(members_, ",\n"), indent_);
  }

 private:
  std::string indent_;
  std::vector<std::string> members_;
};

}  // namespace dottrack::workstation
