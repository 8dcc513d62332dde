#include "tests/unit/geometry/table.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace dottrack::test {
namespace {

std::vector<std::string> fields_of(std::string line) {
  if (line.ends_with('\r')) line.pop_back();
  std::vector<std::string> fields;
  std::istringstream in(line + ',');
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

Table Table::read(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  Table table;
  std::string line;
  std::getline(in, line);
  for (const std::string& name : fields_of(line))
    table.columns_.emplace(name, table.columns_.size());
  while (std::getline(in, line)) {
    table.rows_.push_back(fields_of(line));
    if (table.rows_.back().size() != table.columns_.size()) {
      throw std::runtime_error("a row of another width in " + path.string() + ": " + line);
    }
  }
  return table;
}

const std::string& Table::text(std::size_t row, const std::string& column) const {
  return rows_.at(row).at(columns_.at(column));
}

double Table::number(std::size_t row, const std::string& column) const {
  const std::string& field = text(row, column);
  std::size_t used = 0;
  const double value = std::stod(field, &used);
  if (used != field.size()) throw std::invalid_argument("not a number: " + field);
  return value;
}

}  // namespace dottrack::test
