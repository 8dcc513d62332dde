#include "app/core/image/region_sums.h"

#include <algorithm>
#include <array>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/region_sums.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

#include "app/core/image/box_sums-inl.h"
#include "app/core/image/narrow_sums-inl.h"

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
  HWY_INLINE void move_to(double& sum) {
    sum += hn::GetLane(hn::SumOfLanes(Wide(), hn::Add(even_, odd_)));
    even_ = hn::Zero(Wide());
    odd_ = hn::Zero(Wide());
  }

 private:
  hn::Vec<Wide> even_;
  hn::Vec<Wide> odd_;
};

// The sums over a region's values in lanes; moved on before they could overflow.
class LaneSums {
 public:
  HWY_INLINE explicit LaneSums(RegionSums& sums) : sums_(sums), faintest_(hn::Zero(kLanes)) {
    sums_.of[RegionSums::kV] = 0.0;
    sums_.of[RegionSums::kVx] = 0.0;
    sums_.of[RegionSums::kVy] = 0.0;
    sums_.saturated_px = 0.0;
  }

  // `inside` has ones in the lanes that are pixels of the region, zeros elsewhere.
  HWY_INLINE void add(Vector x, Vector y, Vector inside, Vector pixel, Vector value, Vector flip) {
    value = hn::And(value, inside);
    const auto saturated = hn::VecFromMask(kLanes, hn::Eq(pixel, hn::Set(kLanes, 255)));
    v_.add(value, hn::Set(kLanes, 1));
    vx_.add(value, x);
    vy_.add(value, y);
    saturated_.add(hn::And(saturated, inside), hn::Set(kLanes, -1));
    faintest_ = hn::Max(faintest_, hn::And(hn::Xor(pixel, flip), inside));
    if (++steps_ == kMaxSteps) [[unlikely]] {
      flush();
    }
  }

  void flush() {
    v_.move_to(sums_.of[RegionSums::kV]);
    vx_.move_to(sums_.of[RegionSums::kVx]);
    vy_.move_to(sums_.of[RegionSums::kVy]);
    saturated_.move_to(sums_.saturated_px);
    steps_ = 0;
  }

  // The sense of the faintest pixel is left open.
  HWY_INLINE void finish() {
    flush();
    sums_.faintest_dn = hn::GetLane(hn::MaxOfLanes(kLanes, faintest_));
  }

 private:
  // A step adds 8 products, none above 255 * 2047: together they fit into 31 bits.
  static constexpr int kMaxSteps = 256;
  static_assert(std::int64_t{8} * kMaxSteps * 255 * (core::kMaxImageWidth - 1) <
                (std::int64_t{1} << 31U));

  RegionSums& sums_;
  ProductSum v_, vx_, vy_, saturated_;
  Vector faintest_;  // as far from the polarity's end as it goes
  int steps_ = 0;
};

HWY_INLINE Vector all(int value) {
  return hn::Set(kLanes, static_cast<std::int16_t>(value));
}

// The value sums of a component of any size.
void sum_any_values(const SumsOf& of, const Component& component, RegionSums& sums) {
  const auto lane = hn::Iota(kLanes, 0);
  const bool bright = of.polarity == core::Polarity::bright;
  const auto flip = all(bright ? 255 : 0);
  LaneSums lanes(sums);
  for (std::uint32_t i = component.head; i != Components::kEnd; i = of.components.next_run(i)) {
    const int x = column(of.runs[i].first);
    const int y = row(of.runs[i].first);
    const int n = of.runs[i].last - of.runs[i].first + 1;
    const int room = of.pixels.width_px - x;
    const std::uint8_t* const thresholds =
        of.thresholds.data != nullptr ? of.thresholds.row(y) : nullptr;
    for (int k = 0; k < n; k += kStep) {
      const int count = std::min(n - k, kStep);
      const Vector pixel = load(of.pixels.row(y) + x + k, count, room - k);
      Vector value = pixel;
      if (thresholds != nullptr) {
        value = hn::Abs(hn::Sub(pixel, load(thresholds + x + k, count, kStep)));
      }
      lanes.add(hn::Add(lane, all(x + k - component.x_min)), all(y - component.y_min),
                hn::VecFromMask(kLanes, hn::Lt(lane, all(count))), pixel, value, flip);
    }
  }
  lanes.finish();
  if (bright) sums.faintest_dn = 255 - sums.faintest_dn;
}

// Of a component of any size, those sums that its runs alone give: over the pixels of one, 2 x and
// 12 x^2 have sums in whole numbers of its length n and of its ends' sum s.
HWY_INLINE void sum_outline(const SumsOf& of, const Component& component, RegionSums& sums) {
  std::int64_t x = 0;
  std::int64_t xx = 0;
  std::int64_t y = 0;
  std::int64_t xy = 0;
  std::int64_t yy = 0;
  const PixelKey corner = component.y_min * kRowStep + component.x_min;
  for (std::uint32_t i = component.head; i != Components::kEnd; i = of.components.next_run(i)) {
    const Run run = of.runs[i];
    const std::int64_t n = run.last - run.first + 1;
    const std::int64_t s = column(run.first - corner) + column(run.last - corner);
    const std::int64_t row_y = row(run.first - corner);
    x += n * s;
    xx += n * (3 * s * s + n * n - 1);
    y += n * row_y;
    xy += n * s * row_y;
    yy += n * row_y * row_y;
  }
  sums.of = {static_cast<double>(x / 2),
             static_cast<double>(xx / 12),
             static_cast<double>(y),
             static_cast<double>(xy / 2),
             static_cast<double>(yy),
             1.0,
             0.0,
             0.0};
  sums.has_values = false;
}

void sum_runs(const SumsOf& of, const Component& component, RegionSums& sums) {
#if HWY_TARGET != HWY_SCALAR  // one lane holds no columns
  if (narrow::try_sum<1>(of, component, sums) || narrow::try_sum<2>(of, component, sums)) return;
#endif
  sum_outline(of, component, sums);
}

void sum_all(const SumsOf& of, std::span<const Candidate> candidates, RegionSums* sums) {
  for (const Candidate& candidate : candidates) {
    const Component& component = candidate.component;
    sums->n = component.area_px;
    sums->width = component.x_max - component.x_min + 1;
    sums->height = component.y_max - component.y_min + 1;
    sums->has_values = true;
    if (candidate.box_bits != 0) {
      box::sum(of, component, candidate.box_bits, *sums);
    } else {
      sum_runs(of, component, *sums);
    }
    ++sums;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

void RegionSums::move_corner(int dx, int dy) {
  of[kXx] += dx * (1.0 * dx * n - 2.0 * of[kX]);
  of[kXy] += dx * (1.0 * dy * n - of[kY]) - dy * of[kX];
  of[kYy] += dy * (1.0 * dy * n - 2.0 * of[kY]);
  of[kX] -= 1.0 * dx * n;
  of[kY] -= 1.0 * dy * n;
  of[kVx] -= dx * of[kV];
  of[kVy] -= dy * of[kV];
}

HWY_EXPORT(sum_all);
HWY_EXPORT(sum_any_values);

void sum_regions(const SumsOf& of, std::span<const Candidate> candidates, RegionSums* sums) {
  HWY_DYNAMIC_DISPATCH(sum_all)(of, candidates, sums);
}

void sum_values(const SumsOf& of, const Component& component, RegionSums& sums) {
  HWY_DYNAMIC_DISPATCH(sum_any_values)(of, component, sums);
  sums.has_values = true;
}

}  // namespace dottrack::image
#endif
