#include "app/config/relabelling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "app/core/geometry/orientation.h"

namespace dottrack::config {
namespace {

using Eigen::Vector3d;

constexpr double kDiameterRatio = 1.3;
constexpr std::uint64_t kMostSteps = 4'000'000;  // some tenths of a second
constexpr double kFirstPart = 1.0 / 16.0;        // of the limit, doubled until one is found
constexpr double kPerfect_m = 1e-9;              // none can be found that is better
constexpr std::size_t kMeasuredFrom = 4;         // dots: of fewer, distances say enough

unsigned bit(std::size_t i) {
  return 1U << i;
}

bool similar(double a_m, double b_m) {
  return std::max(a_m, b_m) <= kDiameterRatio * std::min(a_m, b_m);
}

}  // namespace

double Relabelling::misfit_m() const {
  return total_m / std::sqrt(static_cast<double>(dots));
}

RelabellingSearch::RelabellingSearch(const core::Target& target, double noticeable_m)
    : target_(&target), count_(target.dots.size()), noticeable_m_(noticeable_m) {
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t j = 0; j < count_; ++j) {
      distance_m_[i][j] = (target.dots[i].position_m - target.dots[j].position_m).norm();
      if (similar(target.dots[i].diameter_m, target.dots[j].diameter_m)) {
        similar_[i] = static_cast<Labels>(similar_[i] | bit(j));
      }
    }
  }
}

LeastMisfit RelabellingSearch::least(std::size_t dots, double at_most_m) {
  LeastMisfit result;
  for (double limit_m = kFirstPart * at_most_m;; limit_m *= 2.0) {
    limit_m = std::min(limit_m, at_most_m);
    run(Aim::least, dots, limit_m);
    if (best_) result.relabelling = best_;
    if (!complete_) return result;
    result.searched_m = best_ ? best_->total_m : limit_m;
    if (best_ || limit_m >= at_most_m) return result;
  }
}

bool RelabellingSearch::any(std::size_t dots, double at_most_m) {
  run(Aim::any, dots, at_most_m);
  return best_.has_value();
}

std::optional<Relabelling> RelabellingSearch::largest(std::size_t from_dots, double at_most_m) {
  run(Aim::largest, from_dots, at_most_m);
  return best_;
}

// Every relabelling has a first dot that it moves, and each is looked for once: with the dots
// before that one in their places or left out.
void RelabellingSearch::run(Aim aim, std::size_t goal, double at_most_m) {
  aim_ = aim;
  goal_ = goal;
  at_most_m_ = at_most_m;
  best_.reset();
  steps_ = 0;
  stop_ = false;
  rule_out(at_most_m);
  for (std::size_t i = 0; i < count_ && !stop_; ++i) {
    for (std::size_t j = 0; j < count_ && !stop_; ++j) {
      if (i == j || (similar_[i] & bit(j)) == 0) continue;
      LabelsOfDots allowed = compatible_[i][j];
      for (std::size_t k = 0; k < i; ++k) allowed[k] = static_cast<Labels>(allowed[k] & bit(k));
      allowed[i] = 0;
      dot_[0] = static_cast<std::uint8_t>(i);
      label_[0] = static_cast<std::uint8_t>(j);
      depth_ = 1;
      descend(0, allowed);
    }
  }
  complete_ = steps_ <= kMostSteps;
}

void RelabellingSearch::rule_out(double at_most_m) {
  const double most_m = std::numbers::sqrt2 * at_most_m;
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t k = 0; k < count_; ++k) {
      for (std::size_t j = 0; j < count_; ++j) {
        unsigned labels = 0;
        for (std::size_t l = 0; l < count_; ++l) {
          if (l != j && std::abs(distance_m_[i][k] - distance_m_[j][l]) <= most_m) labels |= bit(l);
        }
        compatible_[i][j][k] = static_cast<Labels>(labels & similar_[k]);
      }
    }
  }
}

double RelabellingSearch::bound2() const {
  const bool shrinks = aim_ == Aim::least && best_.has_value();
  const double bound_m = shrinks ? best_->total_m : at_most_m_;
  return bound_m * bound_m;
}

bool RelabellingSearch::enough_left(std::size_t next, const LabelsOfDots& allowed) const {
  std::size_t left = depth_;
  for (std::size_t k = next; k < count_; ++k) left += allowed[k] != 0 ? 1U : 0U;
  return left >= goal_;
}

void RelabellingSearch::descend(std::size_t next, const LabelsOfDots& allowed) {
  if (settled()) return;
  for (std::size_t k = next; k < count_ && !stop_; ++k) {
    if (!enough_left(k, allowed)) return;
    for (std::size_t l = 0; l < count_ && !stop_; ++l) {
      if ((allowed[k] & bit(l)) != 0) extend(k, l, k + 1, allowed);
    }
  }
}

// n times the sum of the squared residuals is at least the sum over the pairs of the squared
// differences of their distances.
void RelabellingSearch::extend(std::size_t dot, std::size_t label, std::size_t next,
                               const LabelsOfDots& allowed) {
  if (++steps_ > kMostSteps) {
    stop_ = true;
    return;
  }
  double sum2 = sum2_[depth_];
  for (std::size_t k = 0; k < depth_; ++k) {
    const double difference = distance_m_[dot][dot_[k]] - distance_m_[label][label_[k]];
    sum2 += difference * difference;
  }
  if (sum2 > static_cast<double>(depth_ + 1) * bound2()) return;
  LabelsOfDots narrower{};
  for (std::size_t k = next; k < count_; ++k) {
    narrower[k] = static_cast<Labels>(allowed[k] & compatible_[dot][label][k]);
  }
  dot_[depth_] = static_cast<std::uint8_t>(dot);
  label_[depth_] = static_cast<std::uint8_t>(label);
  ++depth_;
  sum2_[depth_] = sum2;
  descend(next, narrower);
  --depth_;
}

// Whether nothing more is to be found with the dots taken so far and others.
bool RelabellingSearch::settled() {
  const bool reached = depth_ >= goal_;
  const bool more_may_follow = aim_ == Aim::largest;
  if (!reached && !(more_may_follow && depth_ >= kMeasuredFrom)) return false;
  Relabelling found;
  bool valid = false;
  if (!measure(found, valid)) return !more_may_follow;
  if (found.total_m * found.total_m > bound2()) return true;
  if (reached && valid) keep(found);
  return !more_may_follow;
}

void RelabellingSearch::keep(const Relabelling& found) {
  best_ = found;
  if (aim_ == Aim::largest) {
    goal_ = depth_ + 1;
    stop_ = depth_ == count_;
  } else {
    stop_ = aim_ == Aim::any || found.total_m <= kPerfect_m;
  }
}

// False when the dots determine no motion, as those on a line do: no pose comes of them.
bool RelabellingSearch::measure(Relabelling& relabelling, bool& valid) const {
  std::array<Vector3d, core::kMaxDots> from;
  std::array<Vector3d, core::kMaxDots> to;
  relabelling.label.fill(kLeftOut);
  relabelling.dots = depth_;
  for (std::size_t k = 0; k < depth_; ++k) {
    from[k] = target_->dots[dot_[k]].position_m;
    to[k] = target_->dots[label_[k]].position_m;
    relabelling.label[dot_[k]] = label_[k];
  }
  geometry::RigidMotion motion;
  if (geometry::absolute_orientation({from.data(), depth_}, {to.data(), depth_}, motion) !=
      geometry::OrientationStatus::ok) {
    return false;
  }
  relabelling.total_m = geometry::rms_residual({from.data(), depth_}, {to.data(), depth_}, motion) *
                        std::sqrt(static_cast<double>(depth_));
  relabelling.turn_rad = 2.0 * std::atan2(motion.rotation.vec().norm(), motion.rotation.w());
  double shift2 = 0.0;
  for (const core::TargetDot& dot : target_->dots) {
    shift2 += (motion * dot.position_m - dot.position_m).squaredNorm();
  }
  relabelling.shift_m = std::sqrt(shift2 / static_cast<double>(count_));
  const bool upright = !target_->upright || (motion.rotation * Vector3d::UnitZ()).z() > 0.0;
  valid = upright && relabelling.shift_m > noticeable_m_;
  return true;
}

}  // namespace dottrack::config
