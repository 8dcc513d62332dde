// Sums over the lanes of vectors, for each SIMD target. Included once a target (foreach_target.h).

#if defined(DOTTRACK_IMAGE_LANE_TOTALS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DOTTRACK_IMAGE_LANE_TOTALS_INL_H_
#undef DOTTRACK_IMAGE_LANE_TOTALS_INL_H_
#else
#define DOTTRACK_IMAGE_LANE_TOTALS_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

inline constexpr std::size_t kSumLanes = 8;

// Sums lane by lane, term by term; four terms are totalled at once.
constexpr std::size_t whole_fours(std::size_t terms) {
  return (terms + 3) / 4 * 4;
}
template <std::size_t kTerms>
using SumLanes = std::array<std::array<float, kSumLanes>, whole_fours(kTerms)>;

// Of eight lanes each: ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)), however many lanes a vector has.
#if HWY_TARGET == HWY_SCALAR
template <std::size_t kTerms>
HWY_INLINE void total(const SumLanes<kTerms>& lanes, double* sums) {
  for (std::size_t i = 0; i < kTerms; ++i) {
    const auto& l = lanes[i];
    sums[i] =
        static_cast<double>(((l[0] + l[4]) + (l[2] + l[6])) + ((l[1] + l[5]) + (l[3] + l[7])));
  }
}
#else
template <std::size_t kTerms>
HWY_INLINE void total(const SumLanes<kTerms>& lanes, double* sums) {
  const hn::CappedTag<float, 4> four;
  const auto halves = [&](std::size_t term) {
    const float* of = lanes[term].data();
    return hn::Add(hn::LoadU(four, of), hn::LoadU(four, of + 4));
  };
  const auto pairs = [&](std::size_t term) {
    const auto a = halves(term);
    const auto b = halves(term + 1);
    return hn::Add(hn::InterleaveLower(four, a, b), hn::InterleaveUpper(four, a, b));
  };
  std::array<float, whole_fours(kTerms)> totals;
  for (std::size_t i = 0; i < kTerms; i += 4) {
    const auto first = pairs(i);
    const auto second = pairs(i + 2);
    const auto even = hn::ConcatLowerLower(four, second, first);
    const auto odd = hn::ConcatUpperUpper(four, second, first);
    hn::StoreU(hn::Add(even, odd), four, totals.data() + i);
  }
  for (std::size_t i = 0; i < kTerms; ++i) sums[i] = static_cast<double>(totals[i]);
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#endif
