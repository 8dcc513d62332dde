#pragma once
// Numbers in the bits of a classic CAN frame: bit n is bit n % 8 of byte n / 8, least significant
// first (Intel order, `@1` in a DBC).

#include <array>
#include <cstdint>

namespace dottrack::protocol {

using Payload = std::array<std::uint8_t, 8>;

// Where a number lies: length in 1 to 52 bits.
struct Field {
  unsigned start = 0;
  unsigned length = 0;

  constexpr std::uint64_t mask() const { return (std::uint64_t{1} << length) - 1U; }
  constexpr std::int64_t signed_max() const { return (std::int64_t{1} << (length - 1U)) - 1; }
  // The one value that no measurement has: the most negative.
  constexpr std::int64_t not_available() const { return -signed_max() - 1; }
};

constexpr std::uint64_t to_word(const Payload& payload) {
  std::uint64_t word = 0;
  for (unsigned i = 0; i < 8; ++i) word |= std::uint64_t{payload[i]} << (8U * i);
  return word;
}

constexpr Payload to_payload(std::uint64_t word) {
  Payload payload{};
  for (unsigned i = 0; i < 8; ++i) payload[i] = static_cast<std::uint8_t>(word >> (8U * i));
  return payload;
}

// A value too large for its field loses its upper bits.
constexpr std::uint64_t put(Field field, std::uint64_t value) {
  return (value & field.mask()) << field.start;
}
constexpr std::uint64_t put_signed(Field field, std::int64_t value) {
  return put(field, static_cast<std::uint64_t>(value));
}

constexpr std::uint64_t get(Field field, std::uint64_t word) {
  return (word >> field.start) & field.mask();
}
constexpr std::int64_t get_signed(Field field, std::uint64_t word) {
  const auto value = static_cast<std::int64_t>(get(field, word));
  return value > field.signed_max() ? value - (std::int64_t{1} << field.length) : value;
}

}  // namespace dottrack::protocol
