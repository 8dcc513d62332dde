// What a TableReader reads that is made of several values: choices, lists, tables.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/config/table_reader.h"

namespace dottrack::config {

std::size_t TableReader::choice(std::string_view key, Words words) {
  if (!has(key)) return 0;
  const toml::node* node = table_.get(key);
  const std::string expected = fmt::format("one of {}", fmt::join(words, ", "));
  const auto* word = node->as_string();
  if (word == nullptr) {
    complain_type(key, expected);
    return 0;
  }
  const auto found = std::find(words.begin(), words.end(), word->get());
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  complain(key, in_quotes(word->get()), expected);
  return 0;
}

std::optional<std::vector<double>> TableReader::read_row(std::string_view key,
                                                         const toml::node& node, std::size_t size,
                                                         const NumberRule& rule) {
  const std::size_t where = node.source().begin.line;
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != size) {
    complaint_.add(where,
                   list == nullptr ? fmt::format("{} has {}", key, kind_of(node))
                                   : fmt::format("{} has a list of {}", key, list->size()),
                   rule.expected);
    return std::nullopt;
  }
  std::vector<double> row;
  for (const toml::node& element : *list) {
    const auto value = as_number(element);
    if (!value || !obeys(rule, *value)) {
      const std::string found = value ? shortest(*value) : std::string(kind_of(element));
      complaint_.add(where, fmt::format("{} has {}", key, found), rule.expected);
      return std::nullopt;
    }
    row.push_back(*value);
  }
  return row;
}

std::vector<double> TableReader::numbers(std::string_view key, std::size_t size,
                                         const std::optional<std::vector<double>>& fallback,
                                         const NumberRule& rule) {
  const std::vector<double> nothing(size, 0.0);
  if (!has(key)) {
    if (!fallback) complain_missing(key, rule.expected);
    return fallback.value_or(nothing);
  }
  return read_row(key, *table_.get(key), size, rule).value_or(nothing);
}

std::vector<NumberRow> TableReader::number_rows(std::string_view key, std::size_t columns,
                                                std::size_t at_least, const NumberRule& rule) {
  std::vector<NumberRow> rows;
  if (!has(key)) {
    if (at_least > 0) complain_missing(key, rule.expected);
    return rows;
  }
  const toml::array* list = table_.get(key)->as_array();
  if (list == nullptr) {
    complain_type(key, rule.expected);
    return rows;
  }
  for (const toml::node& element : *list) {
    auto row = read_row(key, element, columns, rule);
    if (row) rows.push_back({std::move(*row), element.source().begin.line});
  }
  if (list->size() < at_least) {
    complain(key, fmt::format("a list of {}", list->size()), rule.expected);
  }
  return rows;
}

const toml::table* TableReader::table(std::string_view key) {
  if (!has(key)) return nullptr;
  const toml::node* node = table_.get(key);
  if (!node->is_table()) complain_type(key, fmt::format("a table [{}]", key));
  return node->as_table();
}

std::vector<const toml::table*> TableReader::tables(std::string_view key) {
  std::vector<const toml::table*> found;
  if (!has(key)) return found;
  const toml::array* list = table_.get(key)->as_array();
  if (list == nullptr || !list->is_array_of_tables()) {
    complain_type(key, fmt::format("tables [[{}]]", key));
    return found;
  }
  for (const toml::node& element : *list) found.push_back(element.as_table());
  return found;
}

}  // namespace dottrack::config
