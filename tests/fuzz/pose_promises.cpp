#include "tests/fuzz/pose_promises.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tests/fuzz/require.h"

namespace dottrack::fuzz {
namespace {

constexpr double kFarthest_m = 838.8608;
constexpr double kUnit = 1e-6;
constexpr std::size_t kRows = 6;

bool within(std::span<const double> values, double limit) {
  return std::all_of(values.begin(), values.end(),
                     [&](double value) { return std::abs(value) <= limit; });
}

void check_rigid(const dottrack_pose& pose) {
  double square = 0.0;
  for (const double part : pose.orientation_wxyz) square += part * part;
  require(within(pose.position_m, kFarthest_m), "a valid pose is within the messages' range");
  require(std::abs(square - 1.0) < kUnit, "a valid pose has a unit quaternion");
  require(!pose.out_of_range, "a valid pose fits into the messages");
}

// Symmetric, no term beyond what its variances allow.
void check_covariance(const dottrack_pose& pose) {
  const std::span<const double, kRows * kRows> c(pose.covariance);
  for (std::size_t i = 0; i < kRows; ++i) {
    const double variance = c[i * kRows + i];
    require(variance >= 0.0 && variance <= 0.32768 * 0.32768, "a variance is within range");
    for (std::size_t j = 0; j < i; ++j) {
      const double covariance = c[i * kRows + j];
      const double bound = std::sqrt(variance * c[j * kRows + j]);
      require(covariance == c[j * kRows + i], "a covariance is symmetric");
      require(std::abs(covariance) <= bound * 1.02 + 1e-15, "a correlation is at most 1");
    }
  }
}

void check_dot(const dottrack_dot& dot) {
  require(dot.visibility <= DOTTRACK_LOCATED, "a dot's visibility has a meaning");
  require(!dot.has_position || within(dot.position_m, kFarthest_m),
          "a dot is within the messages' range");
  require(std::isfinite(dot.sigma_m), "a dot's sigma is a number");
}

}  // namespace

void check_content(const dottrack_pose& pose) {
  require(pose.state <= DOTTRACK_TRACKING, "the state has a meaning");
  require(pose.dots_used <= DOTTRACK_MAX_DOTS && pose.dots <= DOTTRACK_MAX_DOTS,
          "no more dots than there can be");
  require(pose.capture_us < std::uint64_t{1} << 48U, "48 bits of capture time");
  require(std::isfinite(pose.residual_m) && pose.false_lock_probability <= 1.0,
          "residual and false-lock probability are numbers");
  if (pose.valid) check_rigid(pose);
  if (pose.has_covariance) check_covariance(pose);
  require(!pose.has_velocity || within(pose.velocity_m_s, 32.768), "a velocity is within range");
  require(!pose.has_rates || within(pose.rates_rad_s, 16.384), "rates are within range");
  for (std::size_t i = 0; i < pose.dots; ++i) check_dot(pose.dot[i]);
}

}  // namespace dottrack::fuzz
