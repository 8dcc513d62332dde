#pragma once
// Typed, checked reading of one TOML table.

#include <toml++/toml.h>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/config/complaint.h"

namespace dottrack::config {

// What a number may be: above < number <= at_most, in these words.
struct NumberRule {
  double above = 0.0;
  double at_most = std::numeric_limits<double>::max();
  std::string_view expected;
  bool or_equal = false;  // `above` itself may be, too
};

// What a whole number may be, both ends included, in these words.
struct IntegerRule {
  std::int64_t at_least = 0;
  std::int64_t at_most = 0;
  std::string_view expected;
};

using Words = std::span<const std::string_view>;

// Numbers, and the line that they stand on.
struct NumberRow {
  std::vector<double> values;
  std::size_t line = 0;
};

// Every reading returns a value of the asked type; what does not fit is a complaint. Without a
// fallback a key is required. A missing key is reported at the line of the table.
class TableReader {
 public:
  // Complains of the first key that is not among `keys`. `title` is how messages call the table.
  TableReader(Complaint& complaint, const toml::table& table, std::string title, Words keys);
  TableReader(Complaint& complaint, const toml::table& table, std::string title,
              std::initializer_list<std::string_view> keys)
      : TableReader(complaint, table, std::move(title), Words(keys.begin(), keys.size())) {}

  std::string text(std::string_view key, const std::optional<std::string>& fallback = std::nullopt);
  bool boolean(std::string_view key, bool fallback);
  double number(std::string_view key, std::optional<double> fallback, const NumberRule& rule);
  int integer(std::string_view key, std::optional<int> fallback, const IntegerRule& rule);
  std::int64_t whole_number(std::string_view key, std::optional<std::int64_t> fallback,
                            const IntegerRule& rule);

  // One of `words`, by its place among them; the first without the key.
  std::size_t choice(std::string_view key, Words words);
  std::size_t choice(std::string_view key, std::initializer_list<std::string_view> words) {
    return choice(key, Words(words.begin(), words.size()));
  }

  // Two numbers [low, high], each within the rule; low < high.
  std::pair<double, double> number_range(
      std::string_view key, const NumberRule& rule,
      std::optional<std::pair<double, double>> fallback = std::nullopt);
  // Two whole numbers [low, high], each within the rule; low <= high.
  std::pair<int, int> integer_range(std::string_view key, std::pair<int, int> fallback,
                                    const IntegerRule& rule);

  // A list of `size` numbers, each within the rule; the fallback without the key.
  std::vector<double> numbers(std::string_view key, std::size_t size,
                              const std::optional<std::vector<double>>& fallback,
                              const NumberRule& rule);
  // A list of such lists, `at_least` of them; empty without the key where none is needed.
  std::vector<NumberRow> number_rows(std::string_view key, std::size_t columns,
                                     std::size_t at_least, const NumberRule& rule);

  // The table under a key, or nullptr without the key.
  const toml::table* table(std::string_view key);
  // The tables under a key, [[key]]; none without the key.
  std::vector<const toml::table*> tables(std::string_view key);

  const Complaint& complaint() const { return complaint_; }
  bool has(std::string_view key) const { return table_.contains(key); }
  // Where the key stands; where the table stands when the key is missing.
  std::size_t line(std::string_view key) const;
  std::size_t line() const;

  // Complains at the key's line: `key` is `what`.
  void complain(std::string_view key, std::string_view what, std::string_view expected);
  // Complains at a line of the file.
  void complain_at(std::size_t line, std::string_view what, std::string_view expected);

 private:
  void check_keys(Words keys);
  void complain_missing(std::string_view key, std::string_view expected);
  void complain_type(std::string_view key, std::string_view expected);
  const toml::array* two_elements(std::string_view key, std::string_view expected);
  std::optional<std::vector<double>> read_row(std::string_view key, const toml::node& node,
                                              std::size_t size, const NumberRule& rule);

  Complaint& complaint_;
  const toml::table& table_;
  std::string title_;
};

// A number, whole or not; nothing for anything else.
std::optional<double> as_number(const toml::node& node);

// Whether a number is one, finite and within the rule.
bool obeys(const NumberRule& rule, double value);

// "a text", "a whole number", "a table": what a TOML value is, in words.
std::string_view kind_of(const toml::node& node);

}  // namespace dottrack::config
