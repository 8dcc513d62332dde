#include "app/core/image/region_sums.h"

#include <algorithm>
#include <array>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/region_sums.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<std::int16_t, 8>;
using Wide = hn::RepartitionToWide<Lanes>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes kLanes;
constexpr int kStep = static_cast<int>(MaxLanes(Lanes()));

// The first n pixels, n <= kStep; what follows them is anything. `room`: how many may be read.
HWY_INLINE Vector load(const std::uint8_t* pixels, int n, int room) {
  const hn::Rebind<std::uint8_t, Lanes> bytes;
  if (room >= kStep) [[likely]] {
    return hn::PromoteTo(kLanes, hn::LoadU(bytes, pixels));
  }
  std::array<std::uint8_t, 8> copy{};
  std::memcpy(copy.data(), pixels, static_cast<std::size_t>(n));
  return hn::PromoteTo(kLanes, hn::LoadU(bytes, copy.data()));
}

// A sum of products, gathered in 32-bit lanes.
class ProductSum {
 public:
  // Spelled out: a constructor of the compiler's making would be built for another processor.
  HWY_INLINE ProductSum() : even_(hn::Zero(Wide())), odd_(hn::Zero(Wide())) {}

  HWY_INLINE void add(Vector a, Vector b) {
    even_ = hn::ReorderWidenMulAccumulate(Wide(), a, b, even_, odd_);
  }
  HWY_INLINE void move_to(std::int64_t& sum) {
    sum += hn::GetLane(hn::SumOfLanes(Wide(), hn::Add(even_, odd_)));
    even_ = hn::Zero(Wide());
    odd_ = hn::Zero(Wide());
  }

 private:
  hn::Vec<Wide> even_;
  hn::Vec<Wide> odd_;
};

// The sums of a region in lanes; moved to 64 bits before they could overflow.
class LaneSums {
 public:
  HWY_INLINE LaneSums() : brightest_(hn::Zero(kLanes)), darkest_inverse_(hn::Zero(kLanes)) {}

  // `inside` has ones in the lanes that are pixels of the region, zeros elsewhere.
  HWY_INLINE void add(Vector x, Vector y, Vector inside, Vector pixel, Vector value) {
    const auto one = hn::Set(kLanes, 1);
    x = hn::And(x, inside);
    y = hn::And(y, inside);
    value = hn::And(value, inside);
    const auto saturated = hn::VecFromMask(kLanes, hn::Eq(pixel, hn::Set(kLanes, 255)));
    x_.add(x, one);
    y_.add(y, one);
    xx_.add(x, x);
    xy_.add(x, y);
    yy_.add(y, y);
    v_.add(value, one);
    vx_.add(value, x);
    vy_.add(value, y);
    saturated_.add(hn::And(saturated, inside), hn::Set(kLanes, -1));
    const auto inverse = hn::Xor(pixel, hn::Set(kLanes, 255));
    brightest_ = hn::Max(brightest_, hn::And(pixel, inside));
    darkest_inverse_ = hn::Max(darkest_inverse_, hn::And(inverse, inside));
    if (++steps_ == kMaxSteps) [[unlikely]] {
      flush();
    }
  }

  void flush() {
    x_.move_to(sums_.x);
    y_.move_to(sums_.y);
    xx_.move_to(sums_.xx);
    xy_.move_to(sums_.xy);
    yy_.move_to(sums_.yy);
    v_.move_to(sums_.v);
    vx_.move_to(sums_.vx);
    vy_.move_to(sums_.vy);
    saturated_.move_to(sums_.saturated);
    steps_ = 0;
  }

  // All that was added, with n left to fill in.
  HWY_INLINE RegionSums finish() {
    flush();
    sums_.brightest = hn::GetLane(hn::MaxOfLanes(kLanes, brightest_));
    sums_.darkest = 255 - hn::GetLane(hn::MaxOfLanes(kLanes, darkest_inverse_));
    return sums_;
  }

 private:
  // A step adds 8 products, none above 2047^2: together they fit into 31 bits.
  static constexpr int kMaxSteps = 64;
  static_assert(std::int64_t{8} * kMaxSteps * (core::kMaxImageWidth - 1) *
                    (core::kMaxImageWidth - 1) <
                (std::int64_t{1} << 31U));

  RegionSums sums_;
  ProductSum x_, y_, xx_, xy_, yy_, v_, vx_, vy_, saturated_;
  Vector brightest_;
  Vector darkest_inverse_;
  int steps_ = 0;
};

HWY_INLINE Vector all(int value) {
  return hn::Set(kLanes, static_cast<std::int16_t>(value));
}

RegionSums sum_runs(const ImageView& pixels, const ImageView& values, const RunList& runs,
                    const Components& components, const Component& component) {
  const auto lane = hn::Iota(kLanes, 0);
  LaneSums lanes;
  for (std::uint32_t i = component.head; i != Components::kEnd; i = components.next_run(i)) {
    const int x = column(runs[i].first);
    const int y = row(runs[i].first);
    const int n = runs[i].last - runs[i].first + 1;
    const int room = pixels.width_px - x;
    for (int k = 0; k < n; k += kStep) {
      const int count = std::min(n - k, kStep);
      lanes.add(hn::Add(lane, all(x + k - component.x_min)), all(y - component.y_min),
                hn::VecFromMask(kLanes, hn::Lt(lane, all(count))),
                load(pixels.row(y) + x + k, count, room - k),
                load(values.row(y) + x + k, count, room - k));
    }
  }
  RegionSums sums = lanes.finish();
  sums.n = component.area_px;
  return sums;
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(sum_runs);

RegionSums sum_region(const ImageView& pixels, const ImageView& values, const RunList& runs,
                      const Components& components, const Component& component) {
  return HWY_DYNAMIC_DISPATCH(sum_runs)(pixels, values, runs, components, component);
}

}  // namespace dottrack::image
#endif
