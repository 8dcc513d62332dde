#include "app/core/estimation/locate.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "app/core/estimation/robust_step.h"
#include "app/core/geometry/orientation.h"
#include "hal/base/static_vector.h"

namespace dottrack::estimation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix36d = Eigen::Matrix<double, 3, 6>;

// Residuals of few dots say little: the prior that the dots' covariances are right weighs as much
// as this many degrees of freedom.
constexpr double kPriorFreedom = 6.0;

constexpr int kWeightedSteps = 4;

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

struct DotEquations {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double chi2 = 0.0;  // sum of the squared residuals, each in its dot's own standard deviations
};

DotEquations linearise(const core::Target& target, std::span<const LocatedDot> dots,
                       const geometry::RigidMotion& motion) {
  DotEquations sum;
  for (const LocatedDot& dot : dots) {
    const Vector3d& body = target.dots[dot.dot].position_m;
    const Matrix36d j = point_jacobian(motion, body);
    const Vector3d error = dot.position_m - motion * body;
    sum.information += j.transpose() * dot.information * j;
    sum.gradient += j.transpose() * dot.information * error;
    sum.chi2 += error.dot(dot.information * error);
  }
  return sum;
}

// The quaternion method treats every dot and axis alike. Crossed rays know a dot's depth less well
// than its place across the view: a few Gauss-Newton steps weigh each by its covariance.
geometry::RigidMotion weigh(const core::Target& target, std::span<const LocatedDot> dots,
                            geometry::RigidMotion motion) {
  for (int i = 0; i < kWeightedSteps; ++i) {
    const DotEquations normal = linearise(target, dots, motion);
    motion = stepped(motion, normal.information.ldlt().solve(normal.gradient));
  }
  return motion;
}

// The inverse information, scaled up where the residuals are larger than the dots' covariances say.
Matrix6d covariance_of(const DotEquations& normal, int freedom) {
  const double factor = std::max(1.0, (kPriorFreedom + normal.chi2) / (kPriorFreedom + freedom));
  return factor * normal.information.inverse();
}

// Root of the largest position variance that the pose's covariance gives any dot of the target.
double worst_dot_sigma(const core::Target& target, const geometry::RigidMotion& motion,
                       const Matrix6d& covariance) {
  double worst = 0.0;
  for (const core::TargetDot& dot : target.dots) {
    const Matrix36d j = point_jacobian(motion, dot.position_m);
    worst = std::max(worst, (j * covariance * j.transpose()).trace());
  }
  return std::sqrt(worst);
}

double rms_residual(const core::Target& target, std::span<const LocatedDot> dots,
                    const geometry::RigidMotion& motion) {
  double sum = 0.0;
  for (const LocatedDot& dot : dots) {
    sum += (dot.position_m - motion * target.dots[dot.dot].position_m).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(dots.size()));
}

geometry::OrientationStatus start(const core::Target& target, std::span<const LocatedDot> dots,
                                  geometry::RigidMotion& motion) {
  StaticVector<Vector3d, core::kMaxDots> body;
  StaticVector<Vector3d, core::kMaxDots> world;
  for (const LocatedDot& dot : dots) {
    body.push_back(target.dots[dot.dot].position_m);
    world.push_back(dot.position_m);
  }
  return geometry::absolute_orientation(as_span(body), as_span(world), motion);
}

}  // namespace

LocatedDot triangulated_dot(std::size_t dot, const Vector3d& position_m,
                            const Matrix3d& covariance_m2) {
  return {dot, position_m, covariance_m2.inverse()};
}

LocateStatus locate(const core::Target& target, std::span<const LocatedDot> dots,
                    double max_rms_residual_m, core::Pose& pose) {
  if (dots.size() < core::kMinDots) return LocateStatus::too_few_dots;
  geometry::RigidMotion motion;
  if (start(target, dots, motion) != geometry::OrientationStatus::ok) {
    return LocateStatus::degenerate;
  }
  motion = weigh(target, dots, motion);
  const DotEquations normal = linearise(target, dots, motion);
  pose.position_m = motion.translation_m;
  pose.orientation = motion.rotation;
  pose.covariance = covariance_of(normal, 3 * static_cast<int>(dots.size()) - 6);
  pose.rms_residual_m = rms_residual(target, dots, motion);
  if (!(pose.rms_residual_m <= max_rms_residual_m)) return LocateStatus::residual;
  if (!determines_pose(normal.information) ||
      !(worst_dot_sigma(target, motion, pose.covariance) <= max_rms_residual_m)) {
    return LocateStatus::degenerate;
  }
  const bool upright = (motion.rotation * Vector3d::UnitZ()).z() > 0.0;
  return upright || !target.upright ? LocateStatus::ok : LocateStatus::upside_down;
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
