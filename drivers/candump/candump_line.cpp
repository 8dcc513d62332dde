#include "drivers/candump/candump_line.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <utility>

namespace dottrack::drivers {
namespace {

constexpr std::size_t kShortIdentifier = 3;  // hexadecimal digits
constexpr std::size_t kLongIdentifier = 8;
constexpr std::uint32_t kLastShortIdentifier = 0x7FF;
constexpr std::uint32_t kLastLongIdentifier = 0x1FFFFFFF;
constexpr std::uint32_t kErrorBit = 0x20000000;
constexpr std::size_t kClassicLength = 8;
constexpr std::size_t kFdLength = 64;

struct Line {
  LoggedFrame logged;
  bool has_data = true;  // false: a remote request or an error
};

template <class Number>
bool to_number(std::string_view digits, Number& number, int base) {
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number, base);
  return !digits.empty() && error == std::errc{} && stop == end;
}

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

// Takes the next word off the front; empty at the end.
std::string_view take_word(std::string_view& rest) {
  const auto* const begin = std::ranges::find_if_not(rest, is_blank);
  const auto* const end = std::find_if(begin, rest.end(), is_blank);
  const std::string_view word(begin, end);
  rest = std::string_view(end, rest.end());
  return word;
}

// (seconds.fraction), with up to nine digits behind the point.
bool read_time(std::string_view word, Duration& time) {
  if (word.size() < 3 || word.front() != '(' || word.back() != ')') return false;
  const std::string_view inner = word.substr(1, word.size() - 2);
  const std::size_t point = inner.find('.');
  if (point == std::string_view::npos) return false;
  std::string fraction(inner.substr(point + 1));
  if (fraction.empty() || fraction.size() > 9) return false;
  fraction.resize(9, '0');
  std::uint32_t seconds = 0;
  std::uint32_t nanoseconds = 0;
  if (!to_number(inner.substr(0, point), seconds, 10)) return false;
  if (!to_number(std::string_view(fraction), nanoseconds, 10)) return false;
  time = std::chrono::seconds(seconds) + std::chrono::nanoseconds(nanoseconds);
  return true;
}

bool read_identifier(std::string_view digits, Line& line) {
  hal::CanFrame& frame = line.logged.frame;
  if (digits.size() != kShortIdentifier && digits.size() != kLongIdentifier) return false;
  if (!to_number(digits, frame.id, 16)) return false;
  frame.extended = digits.size() == kLongIdentifier;
  line.has_data = !frame.extended || (frame.id & kErrorBit) == 0;
  const std::uint32_t last = !frame.extended ? kLastShortIdentifier
                             : line.has_data ? kLastLongIdentifier
                                             : kLastLongIdentifier | kErrorBit;
  return frame.id <= last;
}

bool add_byte(std::string_view digits, hal::CanFrame& frame) {
  std::uint8_t byte = 0;
  const std::size_t most = frame.fd ? kFdLength : kClassicLength;
  if (frame.length >= most || digits.size() != 2 || !to_number(digits, byte, 16)) return false;
  frame.data[frame.length++] = byte;
  return true;
}

bool add_bytes(std::string_view digits, hal::CanFrame& frame) {
  if (digits.size() % 2 != 0) return false;
  for (; !digits.empty(); digits.remove_prefix(2)) {
    if (!add_byte(digits.substr(0, 2), frame)) return false;
  }
  return true;
}

// #0011, #R, ##10011; a classic frame of 8 bytes may name a longer DLC: _9 to _F.
bool read_log_data(std::string_view data, Line& line) {
  hal::CanFrame& frame = line.logged.frame;
  if (data.starts_with('R')) {
    line.has_data = false;
    return true;
  }
  frame.fd = data.starts_with('#');
  if (!frame.fd) {
    if (data.size() == 2 * kClassicLength + 2 && data[2 * kClassicLength] == '_') {
      data.remove_suffix(2);
    }
    return add_bytes(data, frame);
  }
  std::uint8_t flags = 0;
  if (!to_number(data.substr(1, 1), flags, 16)) return false;
  frame.bit_rate_switch = (flags & 1U) != 0;
  return add_bytes(data.substr(2), frame);
}

// `RX - -`, `TX B E`: what -x puts between the interface and the identifier.
std::string_view skip_direction(std::string_view word, std::string_view& rest,
                                bool& bit_rate_switch) {
  if (word != "RX" && word != "TX") return word;
  bit_rate_switch = take_word(rest) == "B";
  take_word(rest);
  return take_word(rest);
}

// [8] 00 11 ... or remote request
bool read_screen_data(std::string_view rest, Line& line, bool bit_rate_switch) {
  const std::string_view length = take_word(rest);
  hal::CanFrame& frame = line.logged.frame;
  unsigned bytes = 0;
  if (length.size() < 3 || length.front() != '[' || length.back() != ']' ||
      !to_number(length.substr(1, length.size() - 2), bytes, 10)) {
    return false;
  }
  frame.fd = length.size() == 4;
  frame.bit_rate_switch = frame.fd && bit_rate_switch;
  for (unsigned i = 0; i < bytes; ++i) {
    const std::string_view word = take_word(rest);
    if (i == 0 && word == "remote") {
      line.has_data = false;
      return true;
    }
    if (!add_byte(word, frame)) return false;
  }
  return true;
}

std::optional<Line> parse(std::string_view text) {
  Line line;
  if (!read_time(take_word(text), line.logged.time)) return std::nullopt;
  line.logged.interface = take_word(text);
  std::string_view word = take_word(text);
  const std::size_t hash = word.find('#');
  if (hash != std::string_view::npos) {
    if (!read_identifier(word.substr(0, hash), line)) return std::nullopt;
    if (!read_log_data(word.substr(hash + 1), line)) return std::nullopt;
    return line;
  }
  bool bit_rate_switch = false;
  word = skip_direction(word, text, bit_rate_switch);
  if (!read_identifier(word, line)) return std::nullopt;
  if (!read_screen_data(text, line, bit_rate_switch)) return std::nullopt;
  return line;
}

}  // namespace

std::optional<LoggedFrame> parse_candump_line(std::string_view line) {
  std::optional<Line> parsed = parse(line);
  if (!parsed || !parsed->has_data) return std::nullopt;
  return std::move(parsed->logged);
}

bool is_remote_or_error_line(std::string_view line) {
  const std::optional<Line> parsed = parse(line);
  return parsed && !parsed->has_data;
}

}  // namespace dottrack::drivers
