#include "tests/fuzz/dbc_promises.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include "tests/fuzz/require.h"

namespace dottrack::fuzz {
namespace {

bool bit_at(std::span<const std::uint8_t> payload, std::size_t bit) {
  return (payload[bit / 8] & 1U << bit % 8) != 0;
}

// The places of a signal's bits from the lowest on, counted as the file does; nothing when one of
// them is beyond the payload.
std::optional<std::vector<std::size_t>> places(const dbc::DbcSignal& signal, std::size_t bytes) {
  std::vector<std::size_t> bits;
  for (std::size_t i = 0; i < signal.length; ++i) {
    // Motorola: count from the front of the payload, each byte's bit 7 first.
    const std::size_t front = signal.start / 8 * 8 + (7 - signal.start % 8) + i;
    const std::size_t bit = signal.intel ? signal.start + i : front / 8 * 8 + (7 - front % 8);
    if (bit >= bytes * 8) return std::nullopt;
    bits.push_back(bit);
  }
  if (!signal.intel) std::reverse(bits.begin(), bits.end());
  return bits;
}

std::int64_t raw_value(const dbc::DbcSignal& signal, const std::vector<std::size_t>& bits,
                       std::span<const std::uint8_t> payload) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (bit_at(payload, bits[i])) value |= std::uint64_t{1} << i;
  }
  const bool negative = signal.is_signed && bit_at(payload, bits.back());
  for (std::size_t i = bits.size(); negative && i < 64; ++i) value |= std::uint64_t{1} << i;
  return std::bit_cast<std::int64_t>(value);
}

void check_signal(const dbc::DbcSignal& signal, const dbc::DbcMessage& message) {
  require(!signal.name.empty(), "a signal has a name");
  require(signal.length >= 1 && signal.length <= 64, "a signal has 1 to 64 bits");
  require(places(signal, message.length_bytes).has_value(), "a signal lies within its message");
  require(std::isfinite(signal.factor) && std::isfinite(signal.offset),
          "factor and offset are numbers");
}

void check_value(const dbc::DecodedSignal& decoded) {
  const dbc::DbcSignal& signal = *decoded.signal;
  const double number = signal.is_signed
                            ? static_cast<double>(decoded.raw)
                            : static_cast<double>(std::bit_cast<std::uint64_t>(decoded.raw));
  const double expected = number * signal.factor + signal.offset;
  require(decoded.physical == expected || (std::isnan(decoded.physical) && std::isnan(expected)),
          "a physical value is factor and offset on the raw one");
  const auto named = signal.values.find(decoded.raw);
  require(decoded.text == (named == signal.values.end() ? std::string_view{} : named->second),
          "a value's name is that of the file");
}

}  // namespace

void check_file(const dbc::DbcFile& file) {
  for (const dbc::DbcMessage& message : file.messages) {
    require(message.length_bytes <= dbc::kMaxMessageBytes, "a message has at most 64 bytes");
    require(message.id <= (message.extended ? 0x1FFFFFFFU : 0x7FFU), "an identifier fits");
    require(file.find(message.id, message.extended) == &message, "an identifier is unique");
    for (const dbc::DbcSignal& signal : message.signals) check_signal(signal, message);
  }
}

void check_decoded(const dbc::DbcMessage& message, const std::vector<dbc::DecodedSignal>& decoded,
                   std::span<const std::uint8_t> payload) {
  auto next = decoded.begin();
  for (const dbc::DbcSignal& signal : message.signals) {
    const auto bits = places(signal, payload.size());
    if (!bits) continue;
    require(next != decoded.end() && next->signal == &signal, "every signal is decoded in order");
    require(next->raw == raw_value(signal, *bits, payload), "a raw value is the payload's bits");
    check_value(*next++);
  }
  require(next == decoded.end(), "no signal is decoded that does not lie within the payload");
}

}  // namespace dottrack::fuzz
