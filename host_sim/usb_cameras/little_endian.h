#pragma once
// Numbers as USB sends them: the lowest byte first.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dottrack::host_sim {

inline void append(std::vector<std::uint8_t>& bytes, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i, value >>= 8U) {
    bytes.push_back(static_cast<std::uint8_t>(value));
  }
}

// At most 4 bytes.
inline std::uint32_t number_of(std::span<const std::uint8_t> bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) value |= std::uint32_t{bytes[i]} << (8 * i);
  return value;
}

}  // namespace dottrack::host_sim
