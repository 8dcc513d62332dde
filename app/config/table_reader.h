#pragma once
// Typed, checked reading of one TOML table.

#include <toml++/toml.h>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/config/complaint.h"

namespace dottrack::config {

// What a number may be: above < number <= at_most, in these words.
struct NumberRule {
  double above = 0.0;
  double at_most = std::numeric_limits<double>::max();
  std::string_view expected;
};

// What a whole number may be, both ends included, in these words.
struct IntegerRule {
  int at_least = 0;
  int at_most = 0;
  std::string_view expected;
};

// Every reading returns a value of the asked type; what does not fit is a complaint. Without a
// fallback a key is required. A missing key is reported at the line of the table.
class TableReader {
 public:
  // Complains of the first key that is not among `keys`. `title` is how messages call the table.
  TableReader(Complaint& complaint, const toml::table& table, std::string title,
              std::initializer_list<std::string_view> keys);

  std::string text(std::string_view key, const std::optional<std::string>& fallback = std::nullopt);
  bool boolean(std::string_view key, bool fallback);
  double number(std::string_view key, std::optional<double> fallback, const NumberRule& rule);
  int integer(std::string_view key, int fallback, const IntegerRule& rule);

  // Two numbers [low, high], each within the rule; low < high.
  std::pair<double, double> number_range(std::string_view key, const NumberRule& rule);
  // Two whole numbers [low, high], each within the rule; low <= high.
  std::pair<int, int> integer_range(std::string_view key, std::pair<int, int> fallback,
                                    const IntegerRule& rule);

  // Where the key stands; where the table stands when the key is missing.
  std::size_t line(std::string_view key) const;
  std::size_t line() const;

  // Complains at the key's line: `key` is `what`.
  void complain(std::string_view key, std::string_view what, std::string_view expected);

 private:
  void check_keys(std::initializer_list<std::string_view> keys);
  void complain_missing(std::string_view key, std::string_view expected);
  void complain_type(std::string_view key, std::string_view expected);
  const toml::array* two_elements(std::string_view key, std::string_view expected);

  Complaint& complaint_;
  const toml::table& table_;
  std::string title_;
};

// "a text", "a whole number", "a table": what a TOML value is, in words.
std::string_view kind_of(const toml::node& node);

}  // namespace dottrack::config
