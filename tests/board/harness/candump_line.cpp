#include "tests/board/harness/candump_line.h"

#include <charconv>

namespace dottrack::board {
namespace {

constexpr std::size_t kShortIdentifier = 3;  // hexadecimal digits
constexpr std::size_t kClassicLength = 8;

std::optional<std::uint32_t> hexadecimal(std::string_view digits) {
  std::uint32_t value = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<hal::CanFrame> parse_candump_line(std::string_view line) {
  const std::size_t hash = line.find('#');
  if (!line.starts_with('(') || hash == std::string_view::npos) return std::nullopt;
  const std::size_t space = line.rfind(' ', hash);
  if (space == std::string_view::npos || hash - space - 1 != kShortIdentifier) return std::nullopt;
  const auto id = hexadecimal(line.substr(space + 1, kShortIdentifier));
  std::string_view digits = line.substr(hash + 1);
  if (!id || digits.size() % 2 != 0 || digits.size() > 2 * kClassicLength) return std::nullopt;
  hal::CanFrame frame;
  frame.id = *id;
  for (; !digits.empty(); digits.remove_prefix(2)) {
    const auto byte = hexadecimal(digits.substr(0, 2));
    if (!byte) return std::nullopt;
    frame.data[frame.length++] = static_cast<std::uint8_t>(*byte);
  }
  return frame;
}

}  // namespace dottrack::board
