#pragma once
// How probably a selection is not the target but chance: what keeps the tracker from locking onto
// the wrong thing (paper section 4: "very occasionally the tracker would lock onto the wrong
// object").
//
// By Bayes' rule. If a candidate of m dots is the target, its residual is normally distributed with
// the dots' covariances and some systematic error, in a pose that is anywhere in the room; if it is
// chance, clutter happens to lie at each dot's place, as probably as the density of clutter says
// that is seen by as many cameras and is as large. The ratio of the two is the odds; docs/
// false-locks.md derives them and tells how they were checked.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/core/acquisition/finalists.h"
#include "app/core/acquisition/rigid_fit.h"
#include "app/core/acquisition/select.h"
#include "app/core/limits.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "hal/base/static_vector.h"

namespace dottrack::acquisition {

// One dot of a candidate lock.
struct Witness {
  std::size_t dot = 0;                                      // index in the target
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();     // world
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // that the lines' sigmas imply
  double diameter_m = 0.0;                                  // as measured
  int views = 0;                                            // cameras that see it
  std::uint16_t finalist = kNoCandidate;                    // index among the finalists
};
using Witnesses = StaticVector<Witness, core::kMaxDots>;

Witnesses witnesses_of(std::span<const Finalist> finalists, const Selection& selection);

struct CandidateLock {
  core::Pose pose;
  Witnesses witnesses;
  // Natural logarithm of the odds of target to chance, from this tick alone.
  double log_odds = 0.0;
  // Of other explanations of the same images that are nearly as good, at another pose: another
  // labelling of the same dots, another place; as rival_log_odds counts them. At most a few; the
  // best of each kind.
  StaticVector<double, 4> rivals;
};

// The log odds of one tick from places, sizes and views: of the target to everything that is not
// it, clutter alone or clutter in the place of one dot. `finalists`: all there are, the
// candidate's included; what is neither the candidate's nor a splinter of it is clutter. Takes
// ten to fifteen nanoseconds for every pair of a witness and a finalist: charge a budget for it.
double log_odds_of(const core::Target& target, std::span<const Witness> witnesses,
                   const core::Pose& pose, std::span<const Finalist> finalists,
                   double max_rms_residual_m);

// The part of log_odds_of that says how well the places fit; see log_fit. Errors and places in the
// vehicle's frame, from the pose given.
using RigidDots = StaticVector<RigidDot, core::kMaxDots>;
RigidDots rigid_dots(const core::Target& target, std::span<const Witness> witnesses,
                     const core::Pose& pose);

// What another candidate of the same images counts as among a candidate's rivals. One that shares
// none of its dots is chance, as its own log odds say, or it is no chance: a copy of the target.
// One that is too good for chance is as probably the target as the candidate is, whichever fits
// better.
double rival_log_odds(const CandidateLock& candidate, const CandidateLock& rival);
// The same of the log odds of two that share no dot.
double with_copy(double log_odds, double rival_log_odds);

// That the candidate is wrong, given what else explains the images as well: (1 + sum of the
// rivals' odds) / (1 + sum of all odds). Does not overflow for any log odds; 1 when one is no
// number. Rounded to single precision: the last bits of a logarithm differ from library to library.
double false_lock_probability(double log_odds, std::span<const double> rivals);

}  // namespace dottrack::acquisition
