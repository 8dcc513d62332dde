#include "app/core/estimation/locate.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "app/core/geometry/orientation.h"
#include "hal/base/static_vector.h"

namespace dottrack::estimation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix36d = Eigen::Matrix<double, 3, 6>;

// Residuals of few dots say little: the prior that the dots' covariances are right weighs as much
// as this many degrees of freedom.
constexpr double kPriorFreedom = 6.0;

constexpr int kWeightedSteps = 4;

constexpr double kMinPivot = 1e-9;

// Coordinates beyond the six of a pose: with none left over, no residual would show a mistake.
constexpr int kMinFreedom = 2;

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
    const Vector3d error = dot.position_m - motion * body;
    sum.information += j.transpose() * dot.information * j;
    sum.gradient += j.transpose() * dot.information * error;
    sum.chi2 += error.dot(dot.information * error);
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

int coordinates(std::span<const LocatedDot> dots) {
  int n = 0;
  for (const LocatedDot& dot : dots) n += dot.in_depth ? 3 : 2;
  return n;
}

// The inverse information, scaled up where
// the residuals are larger than the dots' covariances say.
Matrix6d covariance_of(const NormalEquations& normal, int freedom) {
  const double factor = std::max(1.0, (kPriorFreedom + normal.chi2) / (kPriorFreedom + freedom));
  return factor * normal.information.inverse();
}

// All six coordinates of the pose are held: no direction of the information, its units taken out,
// is empty.
bool determines_pose(const Matrix6d& information) {
  const Eigen::Matrix<double, 6, 1> scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6d unitless = scale.asDiagonal() * information * scale.asDiagonal();
  return unitless.ldlt().vectorD().minCoeff() > kMinPivot;
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

// Of the dots' distances, across the line of sight only for those not known in depth.
double rms_residual(const core::Target& target, std::span<const LocatedDot> dots,
                    const geometry::RigidMotion& motion) {
  double sum = 0.0;
  for (const LocatedDot& dot : dots) {
    const Vector3d error = dot.position_m - motion * target.dots[dot.dot].position_m;
    // The information of a glimpse is w (I - u u^T): its trace is 2 w.
    sum += dot.in_depth ? error.squaredNorm()
                        : 2.0 * error.dot(dot.information * error) / dot.information.trace();
  }
  return std::sqrt(sum / static_cast<double>(dots.size()));
}

LocateStatus start(const core::Target& target, std::span<const LocatedDot> dots,
                   const core::Pose* previous, geometry::RigidMotion& motion) {
  StaticVector<Vector3d, core::kMaxDots> body;
  StaticVector<Vector3d, core::kMaxDots> world;
  for (const LocatedDot& dot : dots) {
    if (!dot.in_depth) continue;
    body.push_back(target.dots[dot.dot].position_m);
    world.push_back(dot.position_m);
  }
  const auto status = geometry::absolute_orientation(as_span(body), as_span(world), motion);
  if (status == geometry::OrientationStatus::ok) return LocateStatus::ok;
  if (previous != nullptr) {
    motion = {previous->position_m, previous->orientation};
    return LocateStatus::ok;
  }
  return status == geometry::OrientationStatus::degenerate ? LocateStatus::degenerate
                                                           : LocateStatus::too_few_dots;
}

}  // namespace

LocatedDot triangulated_dot(std::size_t dot, const Vector3d& position_m,
                            const Matrix3d& covariance_m2) {
  return {dot, position_m, covariance_m2.inverse(), true};
}

LocatedDot glimpsed_dot(std::size_t dot, const geometry::SightLine& line, const Vector3d& near_m) {
  const Vector3d& u = line.ray.direction;
  const double range_m = (near_m - line.ray.origin).dot(u);
  const double sigma_m = line.sigma_rad * range_m;
  return {dot, line.ray.origin + range_m * u,
          (Matrix3d::Identity() - u * u.transpose()) / (sigma_m * sigma_m), false};
}

LocateStatus locate(const core::Target& target, std::span<const LocatedDot> dots,
                    double max_rms_residual_m, const core::Pose* previous, core::Pose& pose) {
  const int freedom = coordinates(dots) - 6;
  if (dots.size() < core::kMinDots || freedom < kMinFreedom) return LocateStatus::too_few_dots;
  geometry::RigidMotion motion;
  const LocateStatus started = start(target, dots, previous, motion);
  if (started != LocateStatus::ok) return started;
  motion = weigh(target, dots, motion);
  const NormalEquations normal = linearise(target, dots, motion);
  pose.position_m = motion.translation_m;
  pose.orientation = motion.rotation;
  pose.covariance = covariance_of(normal, freedom);
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
