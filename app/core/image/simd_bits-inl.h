// Comparison masks as plain words, for each SIMD target. Included once a target (foreach_target.h).

#if defined(DOTTRACK_IMAGE_SIMD_BITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DOTTRACK_IMAGE_SIMD_BITS_INL_H_
#undef DOTTRACK_IMAGE_SIMD_BITS_INL_H_
#else
#define DOTTRACK_IMAGE_SIMD_BITS_INL_H_
#endif

#include <hwy/highway.h>

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

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#endif
