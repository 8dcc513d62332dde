#pragma once
// One frame of a CAN bus, classic or FD.

#include <array>
#include <cstdint>
#include <span>

namespace dottrack::hal {

struct CanFrame {
  std::uint32_t id = 0;
  bool extended = false;  // 29-bit identifier
  bool fd = false;        // CAN FD frame
  bool bit_rate_switch = false;
  std::uint8_t length = 0;  // bytes used in data: 0 to 8, FD up to 64
  std::array<std::uint8_t, 64> data{};

  std::span<const std::uint8_t> payload() const { return {data.data(), length}; }
};

}  // namespace dottrack::hal
