#pragma once
// Which of at most 16 cameras: one bit each.

#include <bit>
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
  constexpr int size() const { return std::popcount(bits_); }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr std::uint16_t bits() const { return bits_; }
  constexpr bool operator==(const CameraSet&) const = default;

 private:
  std::uint16_t bits_ = 0;
};

}  // namespace dottrack
