#pragma once
// Which identifiers the unit's messages have.

#include <cstdint>

namespace dottrack::protocol {

inline constexpr std::uint32_t kIdentifiers = 64;  // base_id to base_id + 63 belong to a unit
inline constexpr std::uint32_t kDefaultBaseId = 0x300;
inline constexpr std::uint32_t kLastBaseId = 0x7FF - kIdentifiers + 1;
inline constexpr std::uint32_t kLastExtendedBaseId = 0x1FFFFFFF - kIdentifiers + 1;

struct Addressing {
  std::uint32_t base_id = kDefaultBaseId;
  bool extended = false;  // 29-bit identifiers
  bool fd = false;        // the pose in one FD frame of 64 bytes

  bool operator==(const Addressing&) const = default;
};

}  // namespace dottrack::protocol
