#include <algorithm>
#include <array>

#include "app/core/acquisition/select.h"
#include "app/core/geometry/orientation.h"

namespace dottrack::acquisition {
namespace {

double squared(double v) {
  return v * v;
}

}  // namespace

double match_score(const TargetShape& shape, std::span<const DotCandidate> candidates,
                   const Assignment& assignment) {
  double score = 0.0;
  for (std::size_t i = 0; i < shape.dots; ++i) {
    const DotCandidate& a = candidates[assignment[i]];
    score += squared(a.diameter_m - shape.diameter_m[i]);
    for (std::size_t j = i + 1; j < shape.dots; ++j) {
      const double distance = (a.position_m - candidates[assignment[j]].position_m).norm();
      score += squared(distance - shape.distance_m[i][j]);
    }
  }
  return score;
}

bool passes_variance_test(const TargetShape& shape, std::span<const DotCandidate> candidates,
                          const Assignment& assignment) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double sum2 = 0.0;
  const Eigen::Vector3d& base = candidates[assignment[0]].position_m;
  for (std::size_t i = 0; i < shape.dots; ++i) {
    const Eigen::Vector3d p = candidates[assignment[i]].position_m - base;
    sum += p;
    sum2 += p.squaredNorm();
  }
  const auto n = static_cast<double>(shape.dots);
  return sum2 / n - (sum / n).squaredNorm() <= 2.0 * shape.variance_m2;
}

bool passes_upright_test(const TargetShape& shape, std::span<const DotCandidate> candidates,
                         const Assignment& assignment) {
  if (!shape.upright) return true;
  std::array<Eigen::Vector3d, core::kMaxDots> world;
  for (std::size_t i = 0; i < shape.dots; ++i) world[i] = candidates[assignment[i]].position_m;
  geometry::RigidMotion motion;
  const auto status = geometry::absolute_orientation({shape.position_m.data(), shape.dots},
                                                     {world.data(), shape.dots}, motion);
  return status == geometry::OrientationStatus::ok &&
         (motion.rotation * Eigen::Vector3d::UnitZ()).z() > 0.0;
}

double largest_score(const TargetShape& shape, double max_rms_residual_m, std::size_t dots) {
  const auto n = static_cast<double>(dots);
  double score = squared(n * max_rms_residual_m);
  for (std::size_t i = 0; i < shape.dots; ++i) score += squared(0.5 * shape.diameter_m[i]);
  return score;
}

}  // namespace dottrack::acquisition
