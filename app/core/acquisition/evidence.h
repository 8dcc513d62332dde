#pragma once
// How probably a selection is not the target but chance: what keeps the tracker from locking onto
// the wrong thing (paper section 4: "very occasionally the tracker would lock onto the wrong
// object").
//
// A candidate lock of m dots has a residual of d = 3 m - 6 coordinates, what is left of its dots'
// places after the best pose. If it is the target, that residual is normally distributed with the
// dots' covariances. If it is chance, unrelated finalists of density mu_k at each dot's place make
// it evenly distributed, with the expected number per unit of residual volume
//   mu_1 ... mu_m * J,  J = m^(3/2) sqrt(det(sum over dots of (r^2 I - r r^T))), r from their mean,
// for each pose (J: how poses and residuals span the dots' places). The ratio of both, with a prior
// that spreads the target's pose evenly over the work volume and its upright orientations, is the
// odds.

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "app/core/acquisition/finalists.h"
#include "app/core/acquisition/select.h"
#include "app/core/limits.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "hal/base/static_vector.h"
#include "hal/base/time.h"

namespace dottrack::acquisition {

// One dot of a candidate lock.
struct Witness {
  std::size_t dot = 0;                                      // index in the target
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();     // world
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // that the lines' sigmas imply
  double diameter_m = 0.0;                                  // as measured
  int views = 0;                                            // cameras that see it
};
using Witnesses = StaticVector<Witness, core::kMaxDots>;

Witnesses witnesses_of(std::span<const Finalist> finalists, const Selection& selection);

struct CandidateLock {
  core::Pose pose;
  Witnesses witnesses;
  // Natural logarithm of the odds of target to chance, from this tick alone.
  double log_odds = 0.0;
  // The same of other explanations of the same images that are nearly as good: another labelling of
  // the same dots, another place. At most a few; the best of each kind.
  StaticVector<double, 4> rivals;
};

// The log odds of one tick from places, sizes and views. `finalists`: all there are, the
// candidate's included; what is not the candidate's is clutter.
double log_odds_of(const core::Target& target, std::span<const Witness> witnesses,
                   const core::Pose& pose, std::span<const Finalist> finalists,
                   double max_rms_residual_m);

// That the candidate is wrong, given what else explains the images as well: (1 + sum of the
// rivals' odds) / (1 + sum of all odds). Does not overflow for any log odds.
double false_lock_probability(double log_odds, std::span<const double> rivals);

// Evidence of one candidate over several ticks: its pose must persist and move as a vehicle can.
// Random errors average out, so a chance match must fit ever better; and when the candidate has
// moved as one body, clutter would have had to offer another match at the new place.
class GatheredEvidence {
 public:
  GatheredEvidence(const core::Target& target, const core::TrackingLimits& limits);

  void forget();
  // Takes in one tick's candidate and says how probably it is false in the light of all ticks since
  // the chain began. A candidate that the vehicle cannot have reached from the one before, or with
  // other dots, begins a new chain.
  double add(const CandidateLock& candidate, Time captured);
  // Ticks in the chain.
  int ticks() const { return ticks_; }

 private:
  const core::Target* target_;
  const core::TrackingLimits* limits_;
  int ticks_ = 0;
};

}  // namespace dottrack::acquisition
