#include "app/core/acquisition/rigid_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace dottrack::acquisition {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix36d = Eigen::Matrix<double, 3, 6>;

// Systematic errors, as parts of the residual limit; all equally probable.
constexpr std::array<double, 5> kSystematicParts = {0.01, 0.025, 0.065, 0.16, 0.4};

constexpr double kTypicalPart = 0.065;

constexpr double kLogTwoPi = 1.8378770664093453;

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

Matrix36d pose_jacobian(const Vector3d& arm) {
  Matrix36d j;
  j << 1.0, 0.0, 0.0, 0.0, arm.z(), -arm.y(),  //
      0.0, 1.0, 0.0, -arm.z(), 0.0, arm.x(),   //
      0.0, 0.0, 1.0, arm.y(), -arm.x(), 0.0;
  return j;
}

Vector3d middle_of(std::span<const RigidDot> dots) {
  Vector3d sum = Vector3d::Zero();
  for (const RigidDot& dot : dots) sum += dot.arm_m;
  return sum / static_cast<double>(dots.size());
}

// The dots' normal distributions as one of the six coordinates of the pose, that their errors are
// linear in.
struct PoseNormal {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double chi2 = 0.0;
  double log_det = 0.0;
  bool ok = true;
};

PoseNormal pose_normal(std::span<const RigidDot> dots, const Vector3d& middle_m,
                       double systematic_m) {
  PoseNormal sum;
  for (const RigidDot& dot : dots) {
    const Matrix3d covariance =
        dot.covariance_m2 + systematic_m * systematic_m * Matrix3d::Identity();
    const Eigen::LLT<Matrix3d> root(covariance);
    sum.ok = sum.ok && root.info() == Eigen::Success;
    const Matrix36d j = root.matrixL().solve(pose_jacobian(dot.arm_m - middle_m));
    const Vector3d error = root.matrixL().solve(dot.error_m);
    sum.information += j.transpose() * j;
    sum.gradient += j.transpose() * error;
    sum.chi2 += error.squaredNorm();
    sum.log_det += 2.0 * root.matrixLLT().diagonal().array().log().sum();
  }
  return sum;
}

// log_fit with one systematic error.
double log_fit_at(std::span<const RigidDot> dots, const Vector3d& middle_m, double systematic_m) {
  const PoseNormal normal = pose_normal(dots, middle_m, systematic_m);
  const Eigen::LLT<Matrix6d> root(normal.information);
  if (!normal.ok || root.info() != Eigen::Success) return kImpossible;
  const double chi2 = normal.chi2 - root.matrixL().solve(normal.gradient).squaredNorm();
  const double log_det = normal.log_det + 2.0 * root.matrixLLT().diagonal().array().log().sum();
  const auto freedom = 3.0 * static_cast<double>(dots.size()) - 6.0;
  return -0.5 * (chi2 + log_det + freedom * kLogTwoPi);
}

// The mean over the systematic errors of what the function says of each, in logarithms.
template <class LogDensity>
double over_systematic(double max_rms_residual_m, const LogDensity& log_density) {
  std::array<double, kSystematicParts.size()> logs{};
  for (std::size_t i = 0; i < logs.size(); ++i) {
    logs[i] = log_density(kSystematicParts[i] * max_rms_residual_m);
  }
  const double largest = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(largest)) return kImpossible;
  double sum = 0.0;
  for (const double l : logs) sum += std::exp(l - largest);
  return largest + std::log(sum / static_cast<double>(logs.size()));
}

}  // namespace

double log_fit(std::span<const RigidDot> dots, double max_rms_residual_m) {
  if (dots.size() < 3) return kImpossible;
  const Vector3d middle_m = middle_of(dots);
  return over_systematic(max_rms_residual_m, [&](double systematic_m) {
    return log_fit_at(dots, middle_m, systematic_m);
  });
}

bool best_step(std::span<const RigidDot> dots, double max_rms_residual_m, RigidStep& step) {
  const Vector3d middle_m = middle_of(dots);
  const PoseNormal normal = pose_normal(dots, middle_m, kTypicalPart * max_rms_residual_m);
  const Eigen::LLT<Matrix6d> root(normal.information);
  if (!normal.ok || root.info() != Eigen::Success) return false;
  const Vector6d best = root.solve(normal.gradient);
  step = {middle_m, best.head<3>(), best.tail<3>()};
  return true;
}

double log_pair_fit(const RigidDot& a, const RigidDot& b, double max_rms_residual_m) {
  const Vector3d edge = b.arm_m - a.arm_m;
  const Vector3d found = edge + b.error_m - a.error_m;
  const double length_m = edge.norm();
  const double off_m = found.norm() - length_m;
  const Vector3d along = edge / length_m;
  const double own_m2 = along.dot((a.covariance_m2 + b.covariance_m2) * along);
  // The turns that carry the edge onto the found one make a circle; others miss it by an arc.
  const double turns = std::log(2.0 * std::numbers::pi / (length_m * length_m));
  return turns + over_systematic(max_rms_residual_m, [&](double systematic_m) {
           const double variance_m2 = own_m2 + 2.0 * systematic_m * systematic_m;
           return -0.5 * (off_m * off_m / variance_m2 + std::log(variance_m2) + kLogTwoPi);
         });
}

}  // namespace dottrack::acquisition
