#include "tests/bench/byte_sum.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/byte_sum.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::bench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

std::uint64_t sum_bytes(const std::uint8_t* bytes, std::size_t count) {
#if HWY_TARGET == HWY_SCALAR
  std::size_t i = 0;
  std::uint64_t sum = 0;
#else
  const hn::ScalableTag<std::uint8_t> d;
  const hn::ScalableTag<std::uint64_t> d64;
  const std::size_t lanes = hn::Lanes(d);
  auto sum0 = hn::Zero(d64);
  auto sum1 = hn::Zero(d64);
  auto sum2 = hn::Zero(d64);
  auto sum3 = hn::Zero(d64);
  std::size_t i = 0;
  for (; i + 4 * lanes <= count; i += 4 * lanes) {
    sum0 = hn::Add(sum0, hn::SumsOf8(hn::LoadU(d, bytes + i)));
    sum1 = hn::Add(sum1, hn::SumsOf8(hn::LoadU(d, bytes + i + lanes)));
    sum2 = hn::Add(sum2, hn::SumsOf8(hn::LoadU(d, bytes + i + 2 * lanes)));
    sum3 = hn::Add(sum3, hn::SumsOf8(hn::LoadU(d, bytes + i + 3 * lanes)));
  }
  std::uint64_t sum =
      hn::GetLane(hn::SumOfLanes(d64, hn::Add(hn::Add(sum0, sum1), hn::Add(sum2, sum3))));
#endif
  for (; i < count; ++i) sum += bytes[i];
  return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::bench {

HWY_EXPORT(sum_bytes);

std::uint64_t byte_sum(const ImageView& image) {
  std::uint64_t sum = 0;
  for (int y = 0; y < image.height_px; ++y) {
    sum += HWY_DYNAMIC_DISPATCH(sum_bytes)(image.row(y), static_cast<std::size_t>(image.width_px));
  }
  return sum;
}

}  // namespace dottrack::bench
#endif
