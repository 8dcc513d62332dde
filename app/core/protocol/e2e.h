#pragma once
// End-to-end protection in the manner of AUTOSAR: profile 2 for messages of 8 bytes, profile 5 for
// the one of 64.
//
// Profile 2: byte 0 is a CRC-8 (polynomial 0x2F, start 0xFF, not reflected, inverted at the end)
// over bytes 1 to 7 and then the data ID. Profile 5: bytes 0 and 1 are a CRC-16 (polynomial 0x1021,
// start 0xFFFF, not reflected), low byte first, over bytes 2 to 63 and then the data ID, low byte
// first. The data ID is in no message: a message under another one's identifier is found out.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/protocol/can_payload.h"

namespace dottrack::protocol::e2e {

inline constexpr std::uint8_t kCrc8Start = 0xFF;
inline constexpr std::uint16_t kCrc16Start = 0xFFFF;

namespace detail {

constexpr std::size_t kLanes = 8;
template <class Crc>
using Tables = std::array<std::array<Crc, 256>, kLanes>;

// Table k holds what a byte does to the CRC when k more bytes follow it. A CRC is linear, so eight
// bytes need eight look-ups none of which waits for another.
template <class Crc>
constexpr Tables<Crc> make_tables(unsigned polynomial) {
  constexpr unsigned kBits = 8 * sizeof(Crc);
  Tables<Crc> tables{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    unsigned crc = byte << (kBits - 8U);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      for (int bit = 0; bit < 8; ++bit) {
        crc = ((crc >> (kBits - 1U)) & 1U) != 0 ? (crc << 1U) ^ polynomial : crc << 1U;
      }
      tables[lane][byte] = static_cast<Crc>(crc);
    }
  }
  return tables;
}

inline constexpr Tables<std::uint8_t> kCrc8 = make_tables<std::uint8_t>(0x2F);
inline constexpr Tables<std::uint16_t> kCrc16 = make_tables<std::uint16_t>(0x1021);

// The CRC of eight bytes, the first in the lowest bits, after a CRC of 0.
template <class Crc>
constexpr Crc of_eight_bytes(const Tables<Crc>& tables, std::uint64_t bytes) {
  unsigned crc = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    crc ^= tables[kLanes - 1U - i][(bytes >> (8U * i)) & 0xFFU];
  }
  return static_cast<Crc>(crc);
}

}  // namespace detail

// One byte more.
constexpr std::uint8_t crc8(std::uint8_t crc, std::uint8_t byte) {
  return detail::kCrc8[0][crc ^ byte];
}
constexpr std::uint16_t crc16(std::uint16_t crc, std::uint8_t byte) {
  return static_cast<std::uint16_t>((crc << 8U) ^ detail::kCrc16[0][(crc >> 8U) ^ byte]);
}

// What byte 0 of a message of 8 bytes has to be.
constexpr std::uint8_t profile2_crc(std::uint64_t word, std::uint16_t data_id) {
  const std::uint64_t protected_bytes = (word >> 8U) | (std::uint64_t{data_id} << 56U);
  const auto crc = detail::of_eight_bytes(detail::kCrc8, protected_bytes ^ kCrc8Start);
  return static_cast<std::uint8_t>(~crc);
}

// What bytes 0 and 1 of a message of 64 bytes have to be, as a number.
constexpr std::uint16_t profile5_crc(const LongPayload& payload, std::uint16_t data_id) {
  std::uint16_t crc = kCrc16Start;
  for (std::size_t i = 0; i < payload.size(); ++i) {
    const std::uint64_t next = i + 1 < payload.size() ? payload[i + 1] : data_id;
    const std::uint64_t bytes = (payload[i] >> 16U) | (next << 48U);
    const auto first_two = static_cast<std::uint16_t>((crc >> 8U) | (crc << 8U));
    crc = detail::of_eight_bytes(detail::kCrc16, bytes ^ first_two);
  }
  return crc;
}

}  // namespace dottrack::protocol::e2e
