#include "app/core/estimation/locate.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "app/core/geometry/orientation.h"

namespace dottrack::estimation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix36d = Eigen::Matrix<double, 3, 6>;

// Residuals of few dots say little: the prior that the dots' covariances are right weighs as much
// as this many degrees of freedom.
constexpr double kPriorFreedom = 6.0;

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

// d(world point)/d(translation, rotation about the world axes through the vehicle's origin).
Matrix36d point_jacobian(const geometry::RigidMotion& motion, const Vector3d& body) {
  Matrix36d j;
  j << Matrix3d::Identity(), -cross_matrix(motion.rotation * body);
  return j;
}

// How much larger than the dots' covariances their residuals are: at least 1.
double variance_factor(const core::Target& target, std::span<const LocatedDot> dots,
                       const geometry::RigidMotion& motion) {
  double chi2 = 0.0;
  for (const LocatedDot& dot : dots) {
    const Vector3d error = dot.position_m - motion * target.dots[dot.dot].position_m;
    chi2 += error.dot(dot.covariance_m2.ldlt().solve(error));
  }
  const double freedom = 3.0 * static_cast<double>(dots.size()) - 6.0;
  return std::max(1.0, (kPriorFreedom + chi2) / (kPriorFreedom + freedom));
}

// Covariance of the unweighted least-squares pose whose points have the given covariances.
Matrix6d propagate(const core::Target& target, std::span<const LocatedDot> dots,
                   const geometry::RigidMotion& motion) {
  Matrix6d normal = Matrix6d::Zero();
  Matrix6d middle = Matrix6d::Zero();
  for (const LocatedDot& dot : dots) {
    const Matrix36d j = point_jacobian(motion, target.dots[dot.dot].position_m);
    normal += j.transpose() * j;
    middle += j.transpose() * dot.covariance_m2 * j;
  }
  const Matrix6d inverse = normal.ldlt().solve(Matrix6d::Identity());
  return variance_factor(target, dots, motion) * (inverse * middle * inverse.transpose());
}

}  // namespace

LocateStatus locate(const core::Target& target, std::span<const LocatedDot> dots,
                    double max_rms_residual_m, core::Pose& pose) {
  std::array<Vector3d, core::kMaxDots> body;
  std::array<Vector3d, core::kMaxDots> world;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    body[i] = target.dots[dots[i].dot].position_m;
    world[i] = dots[i].position_m;
  }
  const std::span<const Vector3d> body_points(body.data(), dots.size());
  const std::span<const Vector3d> world_points(world.data(), dots.size());
  geometry::RigidMotion motion;
  switch (geometry::absolute_orientation(body_points, world_points, motion)) {
    case geometry::OrientationStatus::too_few_points:
      return LocateStatus::too_few_dots;
    case geometry::OrientationStatus::degenerate:
      return LocateStatus::degenerate;
    case geometry::OrientationStatus::ok:
      break;
  }
  if (target.upright && (motion.rotation * Vector3d::UnitZ()).z() <= 0.0) {
    return LocateStatus::upside_down;
  }
  pose.position_m = motion.translation_m;
  pose.orientation = motion.rotation;
  pose.covariance = propagate(target, dots, motion);
  pose.rms_residual_m = geometry::rms_residual(body_points, world_points, motion);
  return pose.rms_residual_m <= max_rms_residual_m ? LocateStatus::ok : LocateStatus::residual;
}

core::Reason reason_of(LocateStatus status) {
  switch (status) {
    case LocateStatus::ok:
      return core::Reason::none;
    case LocateStatus::too_few_dots:
      return core::Reason::too_few_dots;
    case LocateStatus::degenerate:
      return core::Reason::degenerate_geometry;
    case LocateStatus::upside_down:
      return core::Reason::upside_down;
    case LocateStatus::residual:
      return core::Reason::residual;
  }
  return core::Reason::residual;
}

}  // namespace dottrack::estimation
