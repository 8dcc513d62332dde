#pragma once
// Numbers in the bits of a CAN frame: bit n is bit n % 8 of byte n / 8, least significant first
// (Intel order, `@1` in a DBC). Eight bytes make a word, 64 bytes eight words.

#include <array>
#include <cstddef>
#include <cstdint>

namespace dottrack::protocol {

using Payload = std::array<std::uint8_t, 8>;
using LongPayload = std::array<std::uint64_t, 8>;  // 64 bytes, words of eight

// Where a number lies: length in 1 to 52 bits.
struct Field {
  unsigned start = 0;
  unsigned length = 0;

  constexpr std::uint64_t mask() const { return (std::uint64_t{1} << length) - 1U; }
  constexpr std::int64_t signed_max() const { return (std::int64_t{1} << (length - 1U)) - 1; }
};

constexpr std::uint64_t to_word(const std::uint8_t* bytes) {
  std::uint64_t word = 0;
  for (unsigned i = 0; i < 8; ++i) word |= std::uint64_t{bytes[i]} << (8U * i);
  return word;
}
constexpr void write_word(std::uint64_t word, std::uint8_t* bytes) {
  for (unsigned i = 0; i < 8; ++i) bytes[i] = static_cast<std::uint8_t>(word >> (8U * i));
}

constexpr std::uint64_t to_word(const Payload& payload) {
  return to_word(payload.data());
}
constexpr Payload to_payload(std::uint64_t word) {
  Payload payload{};
  write_word(word, payload.data());
  return payload;
}

// A value too large for its field loses its upper bits.
constexpr std::uint64_t put(const Field& field, std::uint64_t value) {
  return (value & field.mask()) << field.start;
}

// The same for a field anywhere in 64 bytes, whose bits are 0 before.
constexpr void put(const Field& field, std::uint64_t value, LongPayload& payload) {
  const std::size_t word = field.start / 64U;
  const unsigned start = field.start % 64U;
  payload[word] |= (value & field.mask()) << start;
  if (start + field.length > 64U) payload[word + 1U] |= (value & field.mask()) >> (64U - start);
}

constexpr std::uint64_t get(const Field& field, std::uint64_t word) {
  return (word >> field.start) & field.mask();
}

}  // namespace dottrack::protocol
