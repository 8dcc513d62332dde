// Comparison masks as plain words, and lists of set bits without a branch where it could not be
// predicted, for each SIMD target. Included once a target (foreach_target.h).

#if defined(DOTTRACK_IMAGE_SIMD_BITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DOTTRACK_IMAGE_SIMD_BITS_INL_H_
#undef DOTTRACK_IMAGE_SIMD_BITS_INL_H_
#else
#define DOTTRACK_IMAGE_SIMD_BITS_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Bit i of the answer is lane i of the mask.
template <class D>
HWY_INLINE std::uint64_t bits_of(D d, hn::Mask<D> mask) {
  constexpr std::size_t kLanes = MaxLanes(D());
  std::conditional_t<
      (kLanes > 32), std::uint64_t,
      std::conditional_t<(kLanes > 16), std::uint32_t,
                         std::conditional_t<(kLanes > 8), std::uint16_t, std::uint8_t>>>
      bits;
  std::uint8_t bytes[8];
  hn::StoreMaskBits(d, mask, bytes);
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
}

// Which of four bits are set, a byte each, and garbage behind them.
constexpr std::array<std::uint32_t, 16> set_bits_of_four() {
  std::array<std::uint32_t, 16> table{};
  for (unsigned bits = 0; bits < table.size(); ++bits) {
    unsigned shift = 0;
    for (unsigned bit = 0; bit < 4; ++bit) {
      if ((bits >> bit & 1U) == 0) continue;
      table[bits] |= bit << shift;
      shift += 8;
    }
  }
  return table;
}
constexpr std::array<std::uint32_t, 16> kSetBits = set_bits_of_four();

// Lists `start` + the number of each set bit of four; returns how many. Four may be written.
HWY_INLINE std::size_t list_set_bits(unsigned four, std::size_t start, std::uint8_t* list) {
  const std::uint32_t numbers = kSetBits[four] + 0x01010101U * static_cast<std::uint32_t>(start);
  std::memcpy(list, &numbers, sizeof(numbers));
  return static_cast<std::size_t>(std::popcount(four));
}

// Writes key + the position of each set bit, and garbage behind them; returns how many. Two without
// a branch: more in one word are rare.
template <class Key, class Keys>
HWY_INLINE std::size_t write_positions(std::uint64_t bits, Key key, const Keys& keys) {
  const std::uint64_t second = bits & (bits - 1);
  keys[0] = key + std::countr_zero(bits);
  keys[1] = key + std::countr_zero(second);
  std::uint64_t rest = second & (second - 1);
  for (int i = 2; rest != 0; rest &= rest - 1) keys[i++] = key + std::countr_zero(rest);
  return static_cast<std::size_t>(std::popcount(bits));
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#endif
