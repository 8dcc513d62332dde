#include "app/core/geometry/orientation.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace dottrack::geometry {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;
using Points = std::span<const Vector3d>;

constexpr double kMinSpreadRatio2 = 1e-6;  // squared ratio of second to first principal spread
constexpr double kMinEigenGap = 1e-9;      // between the two best quaternions, relative

Vector3d mean(Points points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

Matrix3d scatter(Points a, Points b) {
  const Vector3d mean_a = mean(a);
  const Vector3d mean_b = mean(b);
  Matrix3d sum = Matrix3d::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b).transpose();
  return sum;
}

// The symmetric matrix whose largest eigenvector is the rotation's quaternion (w, x, y, z).
Matrix4d quaternion_form(const Matrix3d& s) {
  Matrix4d n;
  n << s.trace(), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),   //
      0, s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2),  //
      0, 0, s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1),                  //
      0, 0, 0, s(2, 2) - s(0, 0) - s(1, 1);
  return n.selfadjointView<Eigen::Upper>();
}

}  // namespace

bool spans_a_plane(Points points) {
  if (points.size() < 3) return false;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(scatter(points, points),
                                                       Eigen::EigenvaluesOnly);
  const Vector3d& spread2 = solver.eigenvalues();
  return spread2[1] > kMinSpreadRatio2 * spread2[2];
}

OrientationStatus absolute_orientation(Points body, Points world, RigidMotion& motion) {
  if (body.size() < 3 || body.size() != world.size()) return OrientationStatus::too_few_points;
  if (!spans_a_plane(body) || !spans_a_plane(world)) return OrientationStatus::degenerate;
  const Eigen::SelfAdjointEigenSolver<Matrix4d> solver(quaternion_form(scatter(body, world)));
  const Eigen::Vector4d& values = solver.eigenvalues();
  if (!(values[3] - values[2] > kMinEigenGap * values[3])) return OrientationStatus::degenerate;
  const Eigen::Vector4d q = solver.eigenvectors().col(3);
  motion.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  if (motion.rotation.w() < 0.0) motion.rotation.coeffs() *= -1.0;
  motion.translation_m = mean(world) - motion.rotation * mean(body);
  return OrientationStatus::ok;
}

double rms_residual(Points body, Points world, const RigidMotion& motion) {
  double sum = 0.0;
  for (std::size_t i = 0; i < body.size(); ++i) sum += (world[i] - motion * body[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(body.size()));
}

}  // namespace dottrack::geometry
