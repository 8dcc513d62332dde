#include "app/core/acquisition/gathered_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dottrack::acquisition {
namespace {

using Eigen::Vector3d;

// A dot has moved when it is further from where it was than this many standard deviations of both
// places, and the residual limit.
constexpr double kMoved = 4.0;

// No more is made of one move than this, in logarithms of odds: ten thousand. What moves as one
// body may still be part of the vehicle, or another vehicle.
const double kMostForMove = std::log(1e4);

// A tick without a rival counts as one with a rival this much less probable than the candidate,
// while another tick had one: a rival is not forgotten for having been hidden a few times.
constexpr double kFaintRival = -20.0;

// A room is no smaller than this; see Clutter.
constexpr double kLeastRoom_m3 = 4.0;

double sphere(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

// Logarithm of the sum of the rivals' odds, as parts of the candidate's.
double log_rivals(const CandidateLock& candidate) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const double r : candidate.rivals) largest = std::max(largest, r);
  if (!std::isfinite(largest)) return largest;
  double sum = 0.0;
  for (const double r : candidate.rivals) sum += std::exp(r - largest);
  return largest + std::log(sum) - candidate.log_odds;
}

double radius_of(const core::Target& target) {
  Vector3d middle = Vector3d::Zero();
  for (const core::TargetDot& dot : target.dots) {
    middle += dot.position_m / static_cast<double>(target.dots.size());
  }
  double radius = 0.0;
  for (const core::TargetDot& dot : target.dots) {
    radius = std::max(radius, (dot.position_m - middle).norm());
  }
  return radius;
}

}  // namespace

GatheredEvidence::GatheredEvidence(const core::Target& target, const core::TrackingLimits& limits)
    : target_(&target), limits_(&limits) {}

void GatheredEvidence::forget() {
  ticks_ = 0;
  misses_ = 0;
  places_.clear();
}

void GatheredEvidence::miss() {
  if (++misses_ > kMaxMisses) forget();
}

GatheredEvidence::Place GatheredEvidence::place_of(const CandidateLock& candidate) {
  Place place;
  for (const Witness& w : candidate.witnesses) {
    place.dot_m.push_back(w.position_m);
    place.sigma_m.push_back(std::sqrt(w.covariance_m2.trace()));
  }
  return place;
}

bool GatheredEvidence::rests_on_same_dots(const CandidateLock& candidate) const {
  if (candidate.witnesses.size() != sums_.size()) return false;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    if (candidate.witnesses[i].dot != dot_[i]) return false;
  }
  return true;
}

double GatheredEvidence::reach_m() const {
  return target_->max_step_m * (1.0 + misses_);
}

// Since the last candidate, by all dots of the target, those that are not seen too.
bool GatheredEvidence::can_have_come(const CandidateLock& candidate, const Place& place) const {
  const double noise_m = kMoved * (*std::max_element(place.sigma_m.begin(), place.sigma_m.end()) +
                                   *std::max_element(last_.sigma_m.begin(), last_.sigma_m.end()));
  return std::all_of(target_->dots.begin(), target_->dots.end(), [&](const core::TargetDot& dot) {
    const Vector3d now = candidate.pose.orientation * dot.position_m + candidate.pose.position_m;
    const Vector3d before = last_pose_.orientation * dot.position_m + last_pose_.position_m;
    return (now - before).norm() <= reach_m() + noise_m;
  });
}

// Every dot is elsewhere: with one at its old place, clutter need only match the others anew.
bool GatheredEvidence::is_distinct(const Place& place) const {
  const auto moved_from = [&](const Place& before) {
    for (std::size_t i = 0; i < place.dot_m.size(); ++i) {
      const double still_m =
          kMoved * (place.sigma_m[i] + before.sigma_m[i]) + limits_->max_rms_residual_m;
      if ((place.dot_m[i] - before.dot_m[i]).norm() <= still_m) return false;
    }
    return true;
  };
  return std::all_of(places_.begin(), places_.end(), moved_from);
}

// How much more probable a match is where the vehicle can have gone since the last candidate if it
// is the vehicle than if it is chance. The candidate's own odds, with its pose spread over what can
// be reached instead of over a room.
double GatheredEvidence::log_surprise(const CandidateLock& candidate) const {
  const double turn = std::min(std::numbers::pi, reach_m() / radius_of(*target_));
  const double half_turns = 4.0 * std::numbers::pi * std::numbers::pi;
  const double narrower = kLeastRoom_m3 * half_turns / (sphere(reach_m()) * sphere(turn));
  return std::clamp(candidate.log_odds + std::log(narrower), 0.0, kMostForMove);
}

void GatheredEvidence::begin(const CandidateLock& candidate) {
  forget();
  sums_.clear();
  for (std::size_t i = 0; i < candidate.witnesses.size(); ++i) {
    dot_[i] = candidate.witnesses[i].dot;
    sums_.push_back({target_->dots[dot_[i]].position_m});
  }
  other_sum_ = 0.0;
  moves_ = 0.0;
  rival_sum_ = 0.0;
  rival_worst_ = -std::numeric_limits<double>::infinity();
}

void GatheredEvidence::visit(const CandidateLock& candidate, const Place& place) {
  if (places_.size() < places_.capacity() && is_distinct(place)) {
    if (!places_.empty()) moves_ += log_surprise(candidate);
    places_.push_back(place);
  }
  last_ = place;
}

void GatheredEvidence::take_fit(const CandidateLock& candidate) {
  const RigidDots dots = rigid_dots(*target_, as_span(candidate.witnesses), candidate.pose);
  for (std::size_t i = 0; i < dots.size(); ++i) {
    sums_[i].error_m += dots[i].error_m;
    sums_[i].covariance_m2 += dots[i].covariance_m2;
  }
  other_sum_ += candidate.log_odds - log_fit(as_span(dots), limits_->max_rms_residual_m);
}

void GatheredEvidence::take_rivals(double log_rivals) {
  rival_sum_ += std::max(log_rivals, kFaintRival);
  rival_worst_ = std::max(rival_worst_, log_rivals);
}

double GatheredEvidence::probability() const {
  const auto n = static_cast<double>(ticks_);
  RigidDots means = sums_;
  for (RigidDot& dot : means) {
    dot.error_m /= n;
    dot.covariance_m2 /= n * n;
  }
  const double log_odds =
      other_sum_ / n + moves_ + log_fit(as_span(means), limits_->max_rms_residual_m);
  const double rival = log_odds + (rival_worst_ > kFaintRival ? rival_sum_ / n : rival_worst_);
  return false_lock_probability(log_odds, {&rival, 1});
}

double GatheredEvidence::add(const CandidateLock& candidate, Time captured) {
  if (ticks_ > 0 && captured <= captured_) return probability();
  const Place place = place_of(candidate);
  double rivals = log_rivals(candidate);
  if (ticks_ == 0) {
    begin(candidate);
  } else if (!can_have_come(candidate, place)) {
    rivals = std::max(rivals, with_copy(candidate.log_odds, last_log_odds_) - candidate.log_odds);
    begin(candidate);
  } else if (!rests_on_same_dots(candidate)) {
    begin(candidate);
  }
  visit(candidate, place);
  ++ticks_;
  misses_ = 0;
  captured_ = captured;
  last_log_odds_ = candidate.log_odds;
  last_pose_ = candidate.pose;
  take_fit(candidate);
  take_rivals(rivals);
  return probability();
}

}  // namespace dottrack::acquisition
