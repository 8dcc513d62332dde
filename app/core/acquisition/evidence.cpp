#include "app/core/acquisition/evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/core/acquisition/clutter.h"

namespace dottrack::acquisition {
namespace {

// That the target is there to be seen at all.
constexpr double kThere = 0.5;
// That a dot of a target that is there is not found: hidden, out of all views, merged with another.
constexpr double kHidden = 0.2;

// Of the numbers of cameras that may see a dot, a true one is seen by just this many: about two in
// five, while clutter is counted with all that are seen by at least as many.
constexpr double kShareOfViews = 0.4;

// A dot's measured diameter, relative: each dot's own error, and that of all alike, from exposure.
constexpr double kSizeSigma = 0.12;
constexpr double kSizeBias = 0.10;
// No more is made of a set of sizes than this, in logarithms of odds.
constexpr double kLeastForSizes = -8.0;

constexpr double kLogTwoPi = 1.8378770664093453;

constexpr double kLargestExponent = 600.0;

double log_orientations(const core::Target& target) {
  const double all = 8.0 * std::numbers::pi * std::numbers::pi;
  return std::log(target.upright ? 0.5 * all : all);
}

// That the target shows these dots and no others.
double log_prior(const core::Target& target, std::size_t dots) {
  const auto found = static_cast<double>(dots);
  const auto left_out = static_cast<double>(target.dots.size()) - found;
  return std::log(kThere) + found * std::log(1.0 - kHidden) + left_out * std::log(kHidden);
}

// The logarithms of the diameters' ratios to the target's: normal, with a bias in common.
double log_sizes(const core::Target& target, std::span<const Witness> witnesses,
                 const Clutter& clutter) {
  double sum = 0.0;
  double sum2 = 0.0;
  double chance = 0.0;
  for (const Witness& w : witnesses) {
    if (!(w.diameter_m > 0.0)) return kLeastForSizes;
    const double off = std::log(w.diameter_m / target.dots[w.dot].diameter_m);
    sum += off;
    sum2 += off * off;
    chance += clutter.log_size_density(w.diameter_m);
  }
  const auto n = static_cast<double>(witnesses.size());
  const double own = kSizeSigma * kSizeSigma;
  const double all = own + n * kSizeBias * kSizeBias;
  const double chi2 = (sum2 - sum * sum / n) / own + sum * sum / n / all;
  const double log_det = (n - 1.0) * std::log(own) + std::log(all);
  return std::max(kLeastForSizes, -0.5 * (chi2 + log_det + n * kLogTwoPi) - chance);
}

// One candidate against all else that its finalists may be.
struct Weighing {
  const core::Target& target;
  std::span<const Witness> witnesses;
  const Clutter& clutter;
  RigidDots dots;
  double max_rms_residual_m;

  double log_anywhere() const { return -std::log(clutter.room_m3()) - log_orientations(target); }

  // That a dot is seen by so many cameras, over clutter at its place.
  double log_dot(std::size_t i) const {
    return std::log(kShareOfViews) - std::log(clutter.density_per_m3(i));
  }

  // Of the target to clutter.
  double log_odds() const {
    double sum = log_prior(target, witnesses.size()) + log_sizes(target, witnesses, clutter) +
                 log_fit(as_span(dots), max_rms_residual_m) + log_anywhere();
    for (std::size_t i = 0; i < witnesses.size(); ++i) sum += log_dot(i);
    return sum;
  }

  // Of two of the target's dots and clutter at the third's place, to clutter.
  double log_odds_of_pair(std::size_t i, std::size_t j) const {
    const std::array<Witness, 2> pair = {witnesses[i], witnesses[j]};
    return log_prior(target, pair.size()) + log_sizes(target, pair, clutter) +
           log_pair_fit(dots[i], dots[j], max_rms_residual_m) + log_anywhere() + log_dot(i) +
           log_dot(j);
  }

  // Of clutter, or two of three dots, to clutter. A target that hides its third dot needs clutter
  // only somewhere on a ring.
  double log_odds_of_less() const {
    double sum = 1.0;
    for (std::size_t i = 0; i < witnesses.size(); ++i) {
      const double odds = log_odds_of_pair(i, (i + 1) % witnesses.size());
      sum += std::exp(std::min(odds, kLargestExponent));
    }
    return std::log(sum);
  }
};

}  // namespace

Witnesses witnesses_of(std::span<const Finalist> finalists, const Selection& selection) {
  Witnesses witnesses;
  for (std::size_t dot = 0; dot < core::kMaxDots; ++dot) {
    const std::uint16_t i = selection.assignment[dot];
    if (i >= finalists.size()) continue;
    const Finalist& f = finalists[i];
    witnesses.push_back({dot, f.position_m, f.covariance_m2, f.diameter_m, f.cameras.size(), i});
  }
  return witnesses;
}

RigidDots rigid_dots(const core::Target& target, std::span<const Witness> witnesses,
                     const core::Pose& pose) {
  const Eigen::Matrix3d to_vehicle = pose.orientation.toRotationMatrix().transpose();
  RigidDots dots;
  for (const Witness& w : witnesses) {
    const Eigen::Vector3d& ideal_m = target.dots[w.dot].position_m;
    dots.push_back({ideal_m, to_vehicle * (w.position_m - pose.position_m) - ideal_m,
                    to_vehicle * w.covariance_m2 * to_vehicle.transpose()});
  }
  return dots;
}

double log_odds_of(const core::Target& target, std::span<const Witness> witnesses,
                   const core::Pose& pose, std::span<const Finalist> finalists,
                   double max_rms_residual_m) {
  if (witnesses.size() < core::kMinDots) return -std::numeric_limits<double>::infinity();
  const Clutter clutter(target, witnesses, finalists);
  const Weighing weighing{target, witnesses, clutter, rigid_dots(target, witnesses, pose),
                          max_rms_residual_m};
  // Of more dots than three, two that are the target's and clutter at all the others' places are
  // too improbable to matter.
  const double odds = weighing.log_odds();
  return witnesses.size() > core::kMinDots ? odds : odds - weighing.log_odds_of_less();
}

double false_lock_probability(double log_odds, std::span<const double> rivals) {
  if (std::isnan(log_odds)) return 1.0;
  double largest = std::max(0.0, log_odds);
  for (const double rival : rivals) {
    if (!std::isnan(rival)) largest = std::max(largest, rival);
  }
  if (std::isinf(largest)) return 1.0;  // infinite odds are no evidence but a mistake
  double wrong = std::exp(-largest);
  for (const double rival : rivals) {
    if (!std::isnan(rival)) wrong += std::exp(rival - largest);
  }
  return static_cast<float>(wrong / (wrong + std::exp(log_odds - largest)));
}

}  // namespace dottrack::acquisition
