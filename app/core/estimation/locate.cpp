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

constexpr int kWeightedSteps = 3;

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

struct NormalEquations {
  Matrix6d information = Matrix6d::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
  double chi2 = 0.0;  // sum of the squared residuals, each in its dot's own standard deviations
};

NormalEquations linearise(const core::Target& target, std::span<const LocatedDot> dots,
                          const geometry::RigidMotion& motion) {
  NormalEquations sum;
  for (const LocatedDot& dot : dots) {
    const Vector3d& body = target.dots[dot.dot].position_m;
    const Matrix36d j = point_jacobian(motion, body);
    const Matrix3d weight = dot.covariance_m2.inverse();
    const Vector3d error = dot.position_m - motion * body;
    sum.information += j.transpose() * weight * j;
    sum.gradient += j.transpose() * weight * error;
    sum.chi2 += error.dot(weight * error);
  }
  return sum;
}

// A small step: translation, then a rotation about the world axes through the vehicle's origin.
geometry::RigidMotion stepped(const geometry::RigidMotion& motion,
                              const Eigen::Matrix<double, 6, 1>& step) {
  const Vector3d turn = step.tail<3>();
  const double angle = turn.norm();
  geometry::RigidMotion next;
  next.translation_m = motion.translation_m + step.head<3>();
  next.rotation = motion.rotation;
  if (angle > 0.0) next.rotation = Eigen::AngleAxisd(angle, turn / angle) * motion.rotation;
  next.rotation.normalize();
  return next;
}

// The quaternion method treats every dot and axis alike. Crossed rays know a dot's depth less well
// than its place across the view: a few Gauss-Newton steps weigh each by its covariance.
geometry::RigidMotion weigh(const core::Target& target, std::span<const LocatedDot> dots,
                            geometry::RigidMotion motion) {
  for (int i = 0; i < kWeightedSteps; ++i) {
    const NormalEquations normal = linearise(target, dots, motion);
    motion = stepped(motion, normal.information.ldlt().solve(normal.gradient));
  }
  return motion;
}

// The inverse information, scaled up where the residuals are larger than the dots' covariances say.
Matrix6d covariance_of(const NormalEquations& normal, std::size_t dots) {
  const double freedom = 3.0 * static_cast<double>(dots) - 6.0;
  const double factor = std::max(1.0, (kPriorFreedom + normal.chi2) / (kPriorFreedom + freedom));
  return factor * normal.information.ldlt().solve(Matrix6d::Identity());
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
  motion = weigh(target, dots, motion);
  if (target.upright && (motion.rotation * Vector3d::UnitZ()).z() <= 0.0) {
    return LocateStatus::upside_down;
  }
  pose.position_m = motion.translation_m;
  pose.orientation = motion.rotation;
  pose.covariance = covariance_of(linearise(target, dots, motion), dots.size());
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
