#include "app/core/estimation/sighting_bundle.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/estimation/sighting_bundle.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

#include "app/core/estimation/sighting_bounds.h"

HWY_BEFORE_NAMESPACE();
namespace dottrack::estimation {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void describe_all(const DiameterRange& diameter, const RangeWindow& limits,
                  SightingBundle& bundle) {
  const hn::CappedTag<double, 8> lanes;
  const auto least = hn::Set(lanes, kShrink * 0.5 * diameter.min_m);
  const auto most = hn::Set(lanes, kGrow * 0.5 * diameter.max_m);
  const auto limit_near = hn::Set(lanes, limits.near_m);
  const auto limit_far = hn::Set(lanes, limits.far_m);
  for (std::size_t i = 0; i < bundle.size; i += hn::Lanes(lanes)) {
    const auto semi_major = hn::Load(lanes, &bundle.semi_major_px[i]);
    const auto least_scale = hn::Load(lanes, &bundle.least_px_per_rad[i]);
    const auto most_scale = hn::Load(lanes, &bundle.most_px_per_rad[i]);
    const auto near = hn::Div(hn::Mul(least, least_scale), semi_major);
    const auto rimless = hn::Sub(semi_major, hn::Set(lanes, kGrowRim_px));
    const auto far = hn::IfThenElse(hn::Gt(rimless, hn::Zero(lanes)),
                                    hn::Div(hn::Mul(most, most_scale), rimless), limit_far);
    const auto mean = hn::Sqrt(hn::Mul(least_scale, most_scale));
    hn::Store(hn::Max(near, limit_near), lanes, &bundle.near_m[i]);
    hn::Store(hn::Min(far, limit_far), lanes, &bundle.far_m[i]);
    hn::Store(hn::Div(hn::Set(lanes, kCentroidSigma_px), mean), lanes, &bundle.sigma_rad[i]);
    hn::Store(hn::Div(hn::Add(semi_major, semi_major), mean), lanes,
              &bundle.angular_diameter_rad[i]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::estimation
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::estimation {

HWY_EXPORT(describe_all);

void describe_sightings(const DiameterRange& diameter, const RangeWindow& limits,
                        SightingBundle& bundle) noexcept {
  HWY_DYNAMIC_DISPATCH(describe_all)(diameter, limits, bundle);
}

}  // namespace dottrack::estimation
#endif
