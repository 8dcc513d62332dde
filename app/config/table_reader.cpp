#include "app/config/table_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace dottrack::config {
namespace {

std::optional<std::int64_t> as_integer(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return whole->get();
  return std::nullopt;
}

bool obeys(const IntegerRule& rule, std::int64_t value) {
  return value >= rule.at_least && value <= rule.at_most;
}

}  // namespace

// A whole number is a number too; text never is.
std::optional<double> as_number(const toml::node& node) {
  if (const auto* real = node.as_floating_point()) return real->get();
  if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
  return std::nullopt;
}

bool obeys(const NumberRule& rule, double value) {
  const bool high_enough = value > rule.above || (rule.or_equal && value == rule.above);
  return std::isfinite(value) && high_enough && value <= rule.at_most;
}

std::string_view kind_of(const toml::node& node) {
  if (node.is_string()) return "a text";
  if (node.is_integer()) return "a whole number";
  if (node.is_floating_point()) return "a number";
  if (node.is_boolean()) return "true or false";
  if (node.is_array_of_tables()) return "a list of tables";
  if (node.is_array()) return "a list";
  if (node.is_table()) return "a table";
  return "a date or time";
}

TableReader::TableReader(Complaint& complaint, const toml::table& table, std::string title,
                         Words keys)
    : complaint_(complaint), table_(table), title_(std::move(title)) {
  check_keys(keys);
}

// Keys come in alphabetical order; the one that stands first in the file is the one to name.
void TableReader::check_keys(Words keys) {
  const toml::key* first_unknown = nullptr;
  for (const auto& [key, value] : table_) {
    if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
    const bool earlier =
        first_unknown == nullptr || key.source().begin.line < first_unknown->source().begin.line;
    if (earlier) first_unknown = &key;
  }
  if (first_unknown == nullptr) return;
  complaint_.add(first_unknown->source().begin.line,
                 fmt::format("unknown key {} in {}", in_quotes(first_unknown->str()), title_),
                 fmt::format("one of {}", fmt::join(keys, ", ")));
}

std::size_t TableReader::line() const {
  return table_.source().begin.line;
}

std::size_t TableReader::line(std::string_view key) const {
  const auto it = table_.find(key);
  return it == table_.end() ? line() : it->first.source().begin.line;
}

void TableReader::complain(std::string_view key, std::string_view what, std::string_view expected) {
  complaint_.add(line(key), fmt::format("{} is {}", key, what), expected);
}

void TableReader::complain_at(std::size_t line_in_file, std::string_view what,
                              std::string_view expected) {
  complaint_.add(line_in_file, what, expected);
}

void TableReader::complain_missing(std::string_view key, std::string_view expected) {
  complaint_.add(line(), fmt::format("{} has no key \"{}\"", title_, key), expected);
}

void TableReader::complain_type(std::string_view key, std::string_view expected) {
  complain(key, kind_of(*table_.get(key)), expected);
}

std::string TableReader::text(std::string_view key, const std::optional<std::string>& fallback) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    if (!fallback) complain_missing(key, "a text");
    return fallback.value_or("");
  }
  if (const auto* value = node->as_string()) return value->get();
  complain_type(key, "a text");
  return "";
}

bool TableReader::boolean(std::string_view key, bool fallback) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return fallback;
  if (const auto* value = node->as_boolean()) return value->get();
  complain_type(key, "true or false");
  return fallback;
}

double TableReader::number(std::string_view key, std::optional<double> fallback,
                           const NumberRule& rule) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    if (!fallback) complain_missing(key, rule.expected);
    return fallback.value_or(rule.at_most);
  }
  const auto value = as_number(*node);
  if (!value) {
    complain_type(key, rule.expected);
  } else if (!obeys(rule, *value)) {
    complain(key, shortest(*value), rule.expected);
  }
  return value.value_or(rule.at_most);
}

int TableReader::integer(std::string_view key, std::optional<int> fallback,
                         const IntegerRule& rule) {
  return static_cast<int>(whole_number(key, fallback, rule));
}

std::int64_t TableReader::whole_number(std::string_view key, std::optional<std::int64_t> fallback,
                                       const IntegerRule& rule) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    if (!fallback) complain_missing(key, rule.expected);
    return fallback.value_or(rule.at_least);
  }
  const auto value = as_integer(*node);
  if (value && obeys(rule, *value)) return *value;
  if (value) {
    complain(key, std::to_string(*value), rule.expected);
  } else {
    complain_type(key, rule.expected);
  }
  return fallback.value_or(rule.at_least);
}

const toml::array* TableReader::two_elements(std::string_view key, std::string_view expected) {
  const toml::node* node = table_.get(key);
  const toml::array* list = node->as_array();
  if (list == nullptr) {
    complain_type(key, expected);
  } else if (list->size() != 2) {
    complain(key, fmt::format("a list of {}", list->size()), expected);
    return nullptr;
  }
  return list;
}

std::pair<double, double> TableReader::number_range(
    std::string_view key, const NumberRule& rule,
    std::optional<std::pair<double, double>> fallback) {
  const std::pair<double, double> nothing{};
  if (!table_.contains(key)) {
    if (!fallback) complain_missing(key, rule.expected);
    return fallback.value_or(nothing);
  }
  const toml::array* list = two_elements(key, rule.expected);
  if (list == nullptr) return nothing;
  const auto low = as_number(*list->get(0));
  const auto high = as_number(*list->get(1));
  if (low && high && obeys(rule, *low) && obeys(rule, *high) && *low < *high) return {*low, *high};
  complain(key,
           low && high ? fmt::format("[{}, {}]", shortest(*low), shortest(*high))
                       : "not a list of numbers",
           rule.expected);
  return nothing;
}

std::pair<int, int> TableReader::integer_range(std::string_view key, std::pair<int, int> fallback,
                                               const IntegerRule& rule) {
  if (!table_.contains(key)) return fallback;
  const toml::array* list = two_elements(key, rule.expected);
  if (list == nullptr) return fallback;
  const auto low = as_integer(*list->get(0));
  const auto high = as_integer(*list->get(1));
  if (low && high && obeys(rule, *low) && obeys(rule, *high) && *low <= *high) {
    return {static_cast<int>(*low), static_cast<int>(*high)};
  }
  complain(key, low && high ? fmt::format("[{}, {}]", *low, *high) : "not a list of whole numbers",
           rule.expected);
  return fallback;
}

}  // namespace dottrack::config
