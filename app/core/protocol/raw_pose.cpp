#include "app/core/protocol/raw_pose.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/core/protocol/dbc_layout.h"
#include "app/core/protocol/rounding.h"

namespace dottrack::protocol {
namespace {

using layout::Signal;

constexpr double kUnitTolerance = 1e-6;  // far below half a step of the quaternion

constexpr Signal kPosition = layout::position::kX;
constexpr Signal kQuaternion = layout::position2::kQW;
constexpr Signal kResidual = layout::position2::kResidual;
constexpr Signal kFalseLock = layout::quality::kFalseLock;

constexpr Duration step_of(const Signal& signal) {
  return Duration(nearest(signal.factor * 1e9));
}

bool all_fit(const Signal& signal, const Eigen::Vector3d& v) {
  return fits(signal, v.x()) && fits(signal, v.y()) && fits(signal, v.z());
}

// All three or none: a part of a vector would mislead.
std::array<std::uint64_t, 3> raw_vector(const Signal& signal, const Eigen::Vector3d& v,
                                        bool available) {
  if (!available || !all_fit(signal, v)) {
    const std::uint64_t none = signal.not_available();
    return {none, none, none};
  }
  return {raw_nearest(signal, v.x()), raw_nearest(signal, v.y()), raw_nearest(signal, v.z())};
}

bool pose_fits(const PoseMessage& message) {
  return all_fit(kPosition, message.position_m) &&
         std::abs(message.orientation.squaredNorm() - 1.0) < kUnitTolerance;
}

std::uint64_t raw_mid_exposure(Time time) {
  const auto us = std::chrono::floor<std::chrono::microseconds>(time.time_since_epoch());
  return static_cast<std::uint64_t>(us.count());
}

std::uint64_t raw_age(Duration age) {
  constexpr Signal kAge = layout::quality::kAge;
  constexpr Duration kStep = step_of(kAge);
  if (age > kStep * kAge.largest()) return kAge.not_available();
  const Duration up = std::max(age, Duration(0)) + kStep - Duration(1);
  return static_cast<std::uint64_t>(up / kStep);
}

// Saturates: beyond some 6 cm it does not matter how bad the fit is.
std::uint64_t raw_residual(double residual_m) {
  constexpr double kMost = static_cast<double>(kResidual.largest()) * kResidual.factor;
  return raw_rounded_up(kResidual, residual_m > kMost ? kMost : residual_m);
}

// The largest k with probability <= 2^-k. A double is fraction * 2^exponent, 1/2 <= fraction < 1.
std::uint64_t raw_false_lock(double probability) {
  if (!(probability >= 0.0 && probability <= 1.0)) return kFalseLock.not_available();
  if (probability == 0.0) return static_cast<std::uint64_t>(kFalseLock.largest());
  int exponent = 0;
  const double fraction = std::frexp(probability, &exponent);
  const int k = fraction > 0.5 ? -exponent : 1 - exponent;
  return static_cast<std::uint64_t>(std::min<std::int64_t>(k, kFalseLock.largest()));
}

void fill(RawPose& raw, const PoseMessage& message, const CovarianceSignals& covariance) {
  const Eigen::Quaterniond& q = message.orientation;
  raw.position = raw_vector(kPosition, message.position_m, true);
  raw.quaternion_wxyz = {raw_nearest(kQuaternion, q.w()), raw_nearest(kQuaternion, q.x()),
                         raw_nearest(kQuaternion, q.y()), raw_nearest(kQuaternion, q.z())};
  raw.residual = raw_residual(message.residual_m);
  raw.false_lock = raw_false_lock(message.false_lock_probability);
  if (message.covariance) raw.covariance = round_covariance(*message.covariance, covariance);
}

}  // namespace

RawPose raw_pose(const PoseMessage& message, const CovarianceSignals& covariance) {
  const bool fit = message.pose_valid && pose_fits(message);
  RawPose raw;
  raw.valid = fit;
  raw.out_of_range = message.pose_valid && !fit;
  raw.mid_exposure = raw_mid_exposure(message.mid_exposure);
  raw.age = raw_age(message.age);
  raw.position.fill(kPosition.not_available());
  raw.quaternion_wxyz.fill(kQuaternion.not_available());
  raw.residual = kResidual.not_available();
  raw.false_lock = kFalseLock.not_available();
  raw.covariance = no_covariance(covariance);
  if (fit) fill(raw, message, covariance);
  DegradedSet degraded = message.degraded;
  degraded.insert_if(fit && message.covariance && !raw.covariance.available,
                     Degraded::covariance_unknown);
  raw.degraded = degraded.bits();
  return raw;
}

RawMotion raw_motion(const PoseMessage& message, bool valid) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  return {raw_vector(layout::velocity::kVX, message.velocity_m_s.value_or(none),
                     valid && message.velocity_m_s.has_value()),
          raw_vector(layout::rates::kWX, message.rates_rad_s.value_or(none),
                     valid && message.rates_rad_s.has_value())};
}

// No dot is known without error: a sigma of 0 is one that nobody computed.
RawDot raw_dot(const DotReport& dot) {
  const bool available =
      dot.visibility != Visibility::not_seen && all_fit(kPosition, dot.position_m);
  constexpr Signal kSigma = layout::dot1_detail::kSigma;
  return {raw_vector(kPosition, dot.position_m, available),
          available && dot.sigma_m > 0.0 ? raw_rounded_up(kSigma, dot.sigma_m)
                                         : kSigma.not_available()};
}

std::uint64_t raw_group_period(Duration period) {
  constexpr Signal kPeriod = layout::version::kGroupPeriod;
  constexpr Duration kStep = step_of(kPeriod);
  const Duration most = kStep * kPeriod.largest();
  const Duration clamped = std::clamp(period, Duration(0), most);
  return static_cast<std::uint64_t>((clamped + kStep / 2) / kStep);
}

}  // namespace dottrack::protocol
