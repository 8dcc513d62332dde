#include "tests/board/harness/gpio_trace.h"

#include <charconv>
#include <cmath>
#include <string>

namespace dottrack::board {
namespace {

constexpr std::string_view kWrite = ": gpio_value: ";
constexpr std::string_view kBase = ": gpio-base ";

template <class T>
bool take_number(std::string_view& text, T& value) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return false;
  text.remove_prefix(first);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

// The word that ends where the mark begins: seconds with six decimals.
std::optional<Time> time_before(std::string_view head) {
  const auto space = head.rfind(' ');
  if (space == std::string_view::npos) return std::nullopt;
  double seconds = 0.0;
  std::string_view word = head.substr(space);
  if (!take_number(word, seconds) || !word.empty()) return std::nullopt;
  return Time(std::chrono::microseconds(std::llround(seconds * 1e6)));
}

}  // namespace

std::optional<GpioWrite> parse_gpio_write(std::string_view line) {
  const auto mark = line.find(kWrite);
  if (mark == std::string_view::npos) return std::nullopt;
  const auto at = time_before(line.substr(0, mark));
  std::string_view rest = line.substr(mark + kWrite.size());
  GpioWrite write;
  if (!at || !take_number(rest, write.gpio) || !rest.starts_with(" set ")) return std::nullopt;
  rest.remove_prefix(5);
  int value = 0;
  if (!take_number(rest, value)) return std::nullopt;
  write.at = *at;
  write.high = value != 0;
  return write;
}

std::optional<unsigned> parse_gpio_base(std::string_view line) {
  const auto mark = line.find(kBase);
  if (mark == std::string_view::npos) return std::nullopt;
  std::string_view rest = line.substr(mark + kBase.size());
  unsigned base = 0;
  if (!take_number(rest, base)) return std::nullopt;
  return base;
}

bool tells_of_lost_events(std::string_view line) {
  return line.starts_with("CPU:") && line.find("[LOST ") != std::string_view::npos;
}

}  // namespace dottrack::board
