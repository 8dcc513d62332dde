#pragma once
// A table of comma-separated values with a line of headings: what surveys and lists come in.

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/config/complaint.h"
#include "hal/base/result.h"

namespace dottrack::calibrate {

// Headings are told apart without regard to case. Empty lines and lines that begin with # are
// skipped. Complaints name the file and the line; the first one counts.
class CsvTable {
 public:
  // `expected`: the headings, for messages. The table has at least one line.
  static Result<CsvTable> read(const std::filesystem::path& path, const std::string& expected);

  std::size_t rows() const { return rows_.size(); }
  std::size_t line(std::size_t row) const { return lines_[row]; }

  // The first column of one of these names.
  std::optional<std::size_t> column(std::initializer_list<std::string_view> names) const;
  // A column of lengths: "x_m", "x_cm" or "x_mm" for "x"; what a value counts in metres.
  struct Length {
    std::size_t column = 0;
    double unit_m = 1.0;
  };
  std::optional<Length> length(std::string_view name) const;
  bool has(std::string_view name) const { return column({name}).has_value(); }

  const std::string& text(std::size_t row, std::size_t column) const { return rows_[row][column]; }
  // A finite number; else complains and gives 0.
  double number(std::size_t row, std::size_t column);
  double metres(std::size_t row, const Length& length) {
    return number(row, length.column) * length.unit_m;
  }
  std::size_t whole_number(std::size_t row, std::size_t column);

  void complain(std::size_t row, std::string_view what, std::string_view expected) {
    complaint_.add(lines_[row], what, expected);
  }
  const config::Complaint& complaint() const { return complaint_; }

 private:
  explicit CsvTable(const std::string& name) : complaint_(name) {}
  void parse(std::string_view text, const std::string& expected);

  config::Complaint complaint_;
  std::vector<std::string> headings_;  // lower case
  std::vector<std::vector<std::string>> rows_;
  std::vector<std::size_t> lines_;
};

}  // namespace dottrack::calibrate
