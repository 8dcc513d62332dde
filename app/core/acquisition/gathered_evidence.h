#pragma once
// Evidence of one candidate lock over several ticks: its pose must persist and move as a vehicle
// can.

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "app/core/acquisition/evidence.h"
#include "app/core/limits.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "hal/base/static_vector.h"
#include "hal/base/time.h"

namespace dottrack::acquisition {

// Random errors average out over a chain of ticks, so a chance match must fit ever better: by as
// much as the systematic errors allow that log_fit reckons with, and no further. And when the
// candidate has moved as one body, clutter would have had to offer another match at the new place,
// within what the vehicle can reach.
//
// A chain ends, and a new one begins, when a candidate rests on other dots of the target, when a
// dot of it moved further than the vehicle can since the candidate before (max_step_m for each tick
// and its uncertainty), or when more than kMaxMisses ticks passed without one. A candidate that
// breaks a chain has the chain's last candidate for a rival: a moment ago, that explained the
// images as well.
class GatheredEvidence {
 public:
  static constexpr int kMaxMisses = 3;

  GatheredEvidence(const core::Target& target, const core::TrackingLimits& limits);

  void forget();
  // A tick whose search ended without a candidate.
  void miss();
  // Takes in one tick's candidate and says how probably it is false in the light of all ticks since
  // the chain began. A candidate of the same images as the one before, by their time, adds nothing.
  double add(const CandidateLock& candidate, Time captured);
  // Ticks in the chain.
  int ticks() const { return ticks_; }
  // Places, each out of the others' reach by chance, that the chain's candidates have been at.
  int places() const { return static_cast<int>(places_.size()); }

 private:
  // Where the candidate's dots were, in the order of the witnesses.
  struct Place {
    StaticVector<Eigen::Vector3d, core::kMaxDots> dot_m;
    StaticVector<double, core::kMaxDots> sigma_m;
  };

  static Place place_of(const CandidateLock& candidate);
  bool rests_on_same_dots(const CandidateLock& candidate) const;
  double reach_m() const;
  bool can_have_come(const CandidateLock& candidate, const Place& place) const;
  void begin(const CandidateLock& candidate);
  void visit(const CandidateLock& candidate, const Place& place);
  bool is_distinct(const Place& place) const;
  double log_surprise(const CandidateLock& candidate) const;
  void take_fit(const CandidateLock& candidate);
  void take_rivals(double log_rivals);
  double probability() const;

  const core::Target* target_;
  const core::TrackingLimits* limits_;
  int ticks_ = 0;
  int misses_ = 0;
  Time captured_{};
  double last_log_odds_ = 0.0;
  core::Pose last_pose_;
  Place last_;
  std::array<std::size_t, core::kMaxDots> dot_{};  // of the target, by witness
  RigidDots sums_;                                 // of errors and covariances over the ticks
  double other_sum_ = 0.0;                         // of the log odds without the fit
  double moves_ = 0.0;                             // log odds from moving
  double rival_sum_ = 0.0;                         // of the rivals' log odds over the candidate's
  double rival_worst_ = 0.0;
  StaticVector<Place, 8> places_;
};

}  // namespace dottrack::acquisition
