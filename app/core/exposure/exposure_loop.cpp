#include "app/core/exposure/exposure_loop.h"

#include <algorithm>
#include <cmath>

namespace dottrack::exposure {
namespace {

// Off by more than this is seen to at once; by less, when it is so in two ticks one after another.
constexpr double kFarOff = 1.5;
constexpr int kOffTicks = 2;
constexpr double kMostAtOnce = 8.0;
// How far beyond full scale saturated pixels are is unknown: a part of them is taken for little,
// all of them for much.
constexpr double kFewSaturated = 0.25;
constexpr double kCutOfFew = 0.65;
constexpr double kCutOfMany = 0.3;
constexpr double kSame = 0.005;       // of a product
constexpr double kTooLong = 1.1;      // than the dots' motion allows
constexpr double kRoomToGrow = 0.75;  // of the exposure time, where there is gain to take back
constexpr double kDark_dn = 4.0;      // below, an image's mean says nothing

bool within(double ratio, double tolerance) {
  return ratio <= tolerance && ratio * tolerance >= 1.0;
}

// Whether `now` is at least half way, in proportions, from `before` to `ratio` times it.
bool half_way(double before, double now, double ratio) {
  const double root = std::sqrt(ratio);
  return ratio > 1.0 ? now >= before * root : now <= before * root;
}

}  // namespace

bool ExposureLoop::effect_is_due(const Brightness& seen) const {
  if (within(expected_ratio_, 1.0 + kSame)) return false;  // only another split
  if (!before_.saturated && seen.saturated) return expected_ratio_ > 1.0;
  if (before_.saturated && !seen.saturated) return expected_ratio_ < 1.0;
  if (!before_.saturated) return half_way(before_.level_dn, seen.level_dn, expected_ratio_);
  return before_.image_dn > kDark_dn && half_way(before_.image_dn, seen.image_dn, expected_ratio_);
}

bool ExposureLoop::wait_on(const std::optional<Brightness>& seen) {
  if (!waiting_) return false;
  ++waited_ticks_;
  waiting_ = waited_ticks_ < settings_->delay_ticks && !(seen && effect_is_due(*seen));
  return waiting_;
}

double ExposureLoop::ratio_for(const Brightness& seen) const {
  const double ratio = std::clamp(settings_->target_dn / std::max(seen.level_dn, 1.0),
                                  1.0 / kMostAtOnce, kMostAtOnce);
  if (!seen.saturated) return ratio;
  if (seen.level_dn > 255.0) return std::min(ratio, kCutOfFew);
  return seen.saturated_share < kFewSaturated ? std::min(ratio, kCutOfFew) : kCutOfMany;
}

bool ExposureLoop::is_to_change(double ratio, const Brightness& seen) {
  content_ = !seen.saturated && within(ratio, seen.tolerance);
  off_ticks_ = content_ ? 0 : off_ticks_ + 1;
  return !content_ && (off_ticks_ >= kOffTicks || !within(ratio, kFarOff));
}

bool ExposureLoop::badly_split(Duration longest) const {
  const double exposure_s = to_seconds(setting_.exposure);
  const double most_s = to_seconds(std::min(longest, settings_->exposure_max));
  const double least_s = to_seconds(settings_->exposure_min);
  if (exposure_s > kTooLong * std::max(most_s, least_s)) return true;
  return setting_.gain > kTooLong * settings_->gain_min && exposure_s < kRoomToGrow * most_s;
}

ExposureSetting ExposureLoop::split(double product_s, Duration longest) const {
  const Duration most =
      std::max(std::min(longest, settings_->exposure_max), settings_->exposure_min);
  const double wanted_s = product_s / settings_->gain_min;
  const double exposure_s =
      std::clamp(wanted_s, to_seconds(settings_->exposure_min), to_seconds(most));
  // Whole microseconds: what cameras are told.
  const Duration exposure = std::chrono::microseconds(std::llround(1e6 * exposure_s));
  const double gain = std::round(1e3 * product_s / to_seconds(exposure)) * 1e-3;
  return {exposure, std::clamp(gain, settings_->gain_min, settings_->gain_max)};
}

std::optional<ExposureSetting> ExposureLoop::change(const ExposureSetting& next,
                                                    const Brightness& seen) {
  if (next == setting_) return std::nullopt;
  expected_ratio_ = to_seconds(next.exposure) * next.gain / product_s();
  before_ = seen;
  waiting_ = true;
  waited_ticks_ = 0;
  off_ticks_ = 0;
  setting_ = next;
  return next;
}

std::optional<ExposureSetting> ExposureLoop::step(const std::optional<Brightness>& seen,
                                                  Duration longest) {
  if (wait_on(seen)) return std::nullopt;
  at_most_ = at_least_ = false;
  if (!seen) return std::nullopt;
  const double ratio = ratio_for(*seen);
  if (!is_to_change(ratio, *seen)) {
    if (!content_ || !badly_split(longest)) return std::nullopt;
    return change(split(product_s(), longest), *seen);
  }
  const ExposureSetting next = split(ratio * product_s(), longest);
  const double reached = to_seconds(next.exposure) * next.gain / product_s();
  if (within(reached, 1.0 + kSame)) {
    (ratio > 1.0 ? at_most_ : at_least_) = true;
    return std::nullopt;
  }
  return change(next, *seen);
}

std::optional<ExposureSetting> ExposureLoop::set_product(double product_s, Duration longest) {
  if (wait_on(std::nullopt)) return std::nullopt;
  content_ = at_most_ = at_least_ = false;
  return change(split(product_s, longest), {});
}

}  // namespace dottrack::exposure
