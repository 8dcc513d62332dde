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

// A lock on a pose is wrong when a dot of the target is further than this from where it should be.
constexpr double kElsewhere_m = 0.05;

// That something stands around that is just like the target: one in a hundred million.
constexpr double kLogCopy = -18.420680743952367;

constexpr double kLargestExponent = 600.0;
constexpr double kNothing = -std::numeric_limits<double>::infinity();

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
  RigidFit fit{as_span(dots), max_rms_residual_m};

  double log_anywhere() const { return -std::log(clutter.room_m3()) - log_orientations(target); }

  // That a dot is seen by so many cameras, over clutter at its place.
  double log_dot(std::size_t i) const {
    return std::log(kShareOfViews) - std::log(clutter.density_per_m3(i));
  }

  // Of the target to clutter.
  double log_odds() const {
    double sum = log_prior(target, witnesses.size()) + log_sizes(target, witnesses, clutter) +
                 fit.log_density() + log_anywhere();
    for (std::size_t i = 0; i < witnesses.size(); ++i) sum += log_dot(i);
    return sum;
  }

  // Of two of the target's dots and clutter at the third's place, to clutter. A target that hides
  // its third dot needs clutter only somewhere on a ring.
  double log_odds_of_pair(std::size_t i, std::size_t j) const {
    const std::array<Witness, 2> pair = {witnesses[i], witnesses[j]};
    return log_prior(target, pair.size()) + log_sizes(target, pair, clutter) +
           log_pair_fit(dots[i], dots[j], max_rms_residual_m) + log_anywhere() + log_dot(i) +
           log_dot(j);
  }

  // Of the target's dots but for one, with clutter at its place, to clutter. Nothing where the pose
  // is the same without it: then the lock is right all the same.
  double log_odds_without(std::size_t left_out) const {
    if (!moves(left_out)) return kNothing;
    Witnesses others;
    double sum = 0.0;
    for (std::size_t i = 0; i < witnesses.size(); ++i) {
      if (i == left_out) continue;
      others.push_back(witnesses[i]);
      sum += log_dot(i);
    }
    return sum + log_prior(target, others.size()) + log_sizes(target, as_span(others), clutter) +
           fit.log_density_without(left_out) + log_anywhere();
  }

  bool moves(std::size_t left_out) const {
    RigidStep step;
    if (!fit.best_step_without(left_out, step)) return true;
    return std::any_of(target.dots.begin(), target.dots.end(), [&](const core::TargetDot& dot) {
      return step.of(dot.position_m).norm() > kElsewhere_m;
    });
  }

  // Of all that is wrong, to clutter: nothing but clutter, or clutter for one dot.
  double log_odds_of_wrong() const {
    const std::size_t n = witnesses.size();
    double sum = 1.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double odds =
          n > core::kMinDots ? log_odds_without(i) : log_odds_of_pair(i, (i + 1) % n);
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
  if (witnesses.size() < core::kMinDots) return kNothing;
  const Clutter clutter(target, witnesses, finalists);
  const Weighing weighing{target, witnesses, clutter, rigid_dots(target, witnesses, pose),
                          max_rms_residual_m};
  return weighing.log_odds() - weighing.log_odds_of_wrong();
}

double rival_log_odds(const CandidateLock& candidate, const CandidateLock& rival) {
  const bool shared =
      std::any_of(candidate.witnesses.begin(), candidate.witnesses.end(), [&](const Witness& a) {
        return std::any_of(rival.witnesses.begin(), rival.witnesses.end(), [&](const Witness& b) {
          return (a.position_m - b.position_m).norm() <= a.diameter_m;
        });
      });
  return shared ? rival.log_odds : with_copy(candidate.log_odds, rival.log_odds);
}

double with_copy(double log_odds, double rival_log_odds) {
  // Odds of at least one make the copy as probable as the candidate.
  const double copy = log_odds + std::min(0.0, kLogCopy + rival_log_odds);
  return std::max(copy, rival_log_odds);
}

double false_lock_probability(double log_odds, std::span<const double> rivals) {
  double largest = std::max(0.0, log_odds);
  bool known = !std::isnan(log_odds);
  for (const double rival : rivals) {
    largest = std::max(largest, rival);
    known = known && !std::isnan(rival);
  }
  if (!known || std::isinf(largest)) return 1.0;  // infinite odds are no evidence but a mistake
  double wrong = std::exp(-largest);
  for (const double rival : rivals) wrong += std::exp(rival - largest);
  return static_cast<double>(static_cast<float>(wrong / (wrong + std::exp(log_odds - largest))));
}

}  // namespace dottrack::acquisition
