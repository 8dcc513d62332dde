#include "app/config/target_judgement.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace dottrack::config {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegrees = 180.0 / std::numbers::pi;

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

double root_of_largest(const Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues()[2]));
}

}  // namespace

// Of unit errors: the rotation's information is the dots' inertia about their mean, and the
// origin's error is the mean's and what the rotation adds over the lever to it.
Conditioning conditioning_of(const core::Target& target) {
  const auto count = static_cast<double>(target.dots.size());
  Vector3d mean = Vector3d::Zero();
  for (const core::TargetDot& dot : target.dots) mean += dot.position_m / count;
  Matrix3d inertia = Matrix3d::Zero();
  for (const core::TargetDot& dot : target.dots) {
    const Matrix3d r = cross_matrix(dot.position_m - mean);
    inertia -= r * r;
  }
  const Matrix3d rotation = inertia.inverse();
  const Matrix3d lever = cross_matrix(mean);
  const Matrix3d position = Matrix3d::Identity() / count - lever * rotation * lever;
  return {root_of_largest(rotation) * 1e-3 * kDegrees, root_of_largest(position)};
}

bool TargetJudgement::ambiguous() const {
  return all.relabelling && all.relabelling->total_m < needed_m();
}

bool TargetJudgement::well_conditioned() const {
  return conditioning.attitude_deg_per_mm * sigma_m * 1e3 <= kMostAttitude_deg;
}

std::size_t TargetJudgement::dots_needed() const {
  return most ? most->dots + 1 : std::min(target_dots, kFewestDots);
}

TargetJudgement judge(const core::Target& target, double sigma_m, double reach) {
  TargetJudgement judgement;
  judgement.target_dots = target.dots.size();
  judgement.sigma_m = sigma_m;
  judgement.conditioning = conditioning_of(target);
  RelabellingSearch search(target, kNoticeable * sigma_m);
  const double needed_m = judgement.needed_m();
  const std::size_t fewest = std::min(target.dots.size(), kFewestDots);
  judgement.all = search.least(target.dots.size(), reach * needed_m);
  if (fewest < target.dots.size()) judgement.few = search.least(fewest, reach * needed_m);
  judgement.most = search.largest(fewest, needed_m);
  judgement.complete =
      search.complete() && (judgement.ambiguous() || judgement.all.searched_m >= needed_m);
  return judgement;
}

}  // namespace dottrack::config
