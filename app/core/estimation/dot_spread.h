#pragma once
// How far the middles of the dots' light are from their places on the target. Survey, shadows and
// lamps shift them alike in all pictures, so that no view's residual shows it; what the dots
// together disagree with the target by, beyond the noise of their views, does.

#include <Eigen/Core>
#include <limits>
#include <span>

#include "app/core/estimation/robust_step.h"
#include "app/core/estimation/view_rows.h"

namespace dottrack::estimation {

// What one tick's views say of the variance of a dot's place, each coordinate: about sum / weight,
// where the weight is their information on it.
struct SpreadEvidence {
  double sum = 0.0;     // without unit
  double weight = 0.0;  // 1/m^2

  double variance_m2() const { return weight > 0.0 ? sum / weight : 0.0; }  // may be negative
};

// By the method of moments, from the rows used about the pose that fits them best, whitened with
// `assumed_m2` for each dot's place. Its mean is the true variance, whatever was assumed and
// whatever the cameras' model errors are, as far as those are independent from camera to camera.
// `information`: of a step of the pose.
SpreadEvidence spread_evidence(std::span<const ViewRow> rows, const Flags& used,
                               const Matrix6d& information, double assumed_m2);

// The variance over some ticks. Light changes as the vehicle moves: what is old counts for less.
class DotSpread {
 public:
  DotSpread() = default;
  // Dots that are known to be in their places: nothing is learnt.
  static DotSpread none() { return DotSpread({0.0, std::numeric_limits<double>::infinity()}); }

  double variance_m2() const;
  double variance_with(const SpreadEvidence& evidence) const;  // once this is taken in, too
  void take_in(const SpreadEvidence& evidence);

 private:
  explicit DotSpread(const SpreadEvidence& taken) : taken_(taken) {}

  SpreadEvidence taken_;
};

}  // namespace dottrack::estimation
