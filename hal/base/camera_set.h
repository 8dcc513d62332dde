#pragma once
// Which of at most 16 cameras: one bit each.

#include <cstddef>
#include <cstdint>

namespace dottrack {

inline constexpr std::size_t kMaxCameras = 16;

class CameraSet {
 public:
  constexpr CameraSet() = default;
  constexpr explicit CameraSet(std::uint16_t bits) : bits_(bits) {}
  static constexpr CameraSet first(std::size_t n) {
    return CameraSet(static_cast<std::uint16_t>((1U << n) - 1U));
  }

  constexpr bool contains(std::size_t camera) const { return ((bits_ >> camera) & 1U) != 0; }
  constexpr void insert(std::size_t camera) {
    bits_ = static_cast<std::uint16_t>(bits_ | (1U << camera));
  }
  constexpr void erase(std::size_t camera) {
    bits_ = static_cast<std::uint16_t>(bits_ & ~(1U << camera));
  }
  // Spelled out: without the processor's own instruction, which not all have, std::popcount is a
  // call, and acquisition counts cameras tens of thousands of times in a tick.
  constexpr int size() const {
    unsigned n = bits_ - ((bits_ >> 1U) & 0x5555U);
    n = (n & 0x3333U) + ((n >> 2U) & 0x3333U);
    n = (n + (n >> 4U)) & 0x0F0FU;
    return static_cast<int>((n + (n >> 8U)) & 0x1FU);
  }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr std::uint16_t bits() const { return bits_; }
  constexpr bool operator==(const CameraSet&) const = default;

 private:
  std::uint16_t bits_ = 0;
};

}  // namespace dottrack
