#pragma once
// A CSV table with a header, whole, for tests.

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dottrack::test {

class Table {
 public:
  // Throws std::runtime_error when the file is missing or a row is not as wide as the header.
  static Table read(const std::filesystem::path& path);

  std::size_t size() const { return rows_.size(); }
  const std::string& text(std::size_t row, const std::string& column) const;
  // The field as a number; an empty field or any other text throws std::invalid_argument.
  double number(std::size_t row, const std::string& column) const;

 private:
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace dottrack::test
