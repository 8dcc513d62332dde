#include <algorithm>
#include <array>
#include <functional>

#include "app/core/acquisition/select.h"
#include "app/core/geometry/orientation.h"
#include "hal/base/static_vector.h"

namespace dottrack::acquisition {
namespace {

using Points = StaticVector<Eigen::Vector3d, core::kMaxDots>;

double squared(double v) {
  return v * v;
}

// The matched dots, ideal and found, in the target's order.
struct MatchedDots {
  Points ideal_m;
  Points found_m;

  MatchedDots(const TargetShape& shape, std::span<const DotCandidate> candidates,
              const Assignment& assignment) {
    for (std::size_t i = 0; i < shape.dots; ++i) {
      if (assignment[i] == kNoCandidate) continue;
      ideal_m.push_back(shape.position_m[i]);
      found_m.push_back(candidates[assignment[i]].position_m);
    }
  }
};

// Mean squared distance from the mean. The first point serves as the origin, against rounding.
double variance_m2(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double sum2 = 0.0;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = point - points.front();
    sum += p;
    sum2 += p.squaredNorm();
  }
  const auto n = static_cast<double>(points.size());
  return sum2 / n - (sum / n).squaredNorm();
}

}  // namespace

double match_score(const TargetShape& shape, std::span<const DotCandidate> candidates,
                   const Assignment& assignment) {
  double score = 0.0;
  for (std::size_t i = 0; i < shape.dots; ++i) {
    if (assignment[i] == kNoCandidate) continue;
    const DotCandidate& a = candidates[assignment[i]];
    score += squared(a.diameter_m - shape.diameter_m[i]);
    for (std::size_t j = i + 1; j < shape.dots; ++j) {
      if (assignment[j] == kNoCandidate) continue;
      const double distance = (a.position_m - candidates[assignment[j]].position_m).norm();
      score += squared(distance - shape.distance_m[i][j]);
    }
  }
  return score;
}

bool passes_variance_test(const TargetShape& shape, std::span<const DotCandidate> candidates,
                          const Assignment& assignment) {
  const MatchedDots dots(shape, candidates, assignment);
  return variance_m2(dots.found_m) <= 2.0 * variance_m2(dots.ideal_m);
}

bool passes_upright_test(const TargetShape& shape, std::span<const DotCandidate> candidates,
                         const Assignment& assignment) {
  if (!shape.upright) return true;
  const MatchedDots dots(shape, candidates, assignment);
  geometry::RigidMotion motion;
  const auto status =
      geometry::absolute_orientation(as_span(dots.ideal_m), as_span(dots.found_m), motion);
  return status == geometry::OrientationStatus::ok &&
         (motion.rotation * Eigen::Vector3d::UnitZ()).z() > 0.0;
}

double largest_score(const TargetShape& shape, double max_rms_residual_m, std::size_t dots) {
  auto diameters_m = shape.diameter_m;
  std::sort(diameters_m.begin(), diameters_m.end(), std::greater<>());
  double score = squared(static_cast<double>(dots) * max_rms_residual_m);
  for (std::size_t i = 0; i < dots; ++i) score += squared(0.5 * diameters_m[i]);
  return score;
}

}  // namespace dottrack::acquisition
