#include "app/core/acquisition/rigid_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
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

// Systematic errors, as parts of the residual limit; all equally probable.
constexpr std::array<double, 5> kSystematicParts = {0.01, 0.025, 0.065, 0.16, 0.4};

constexpr std::size_t kTypical = 2;

constexpr double kLogTwoPi = 1.8378770664093453;

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

Vector3d middle_of(std::span<const RigidDot> dots) {
  Vector3d sum = Vector3d::Zero();
  for (const RigidDot& dot : dots) sum += dot.arm_m;
  return sum / static_cast<double>(dots.size());
}

// Each column crossed with a vector on its left.
Matrix3d cross_columns(const Vector3d& v, const Matrix3d& m) {
  Matrix3d crossed;
  for (int i = 0; i < 3; ++i) crossed.col(i) = v.cross(m.col(i));
  return crossed;
}

// The mean over the systematic errors of what the function says of each, in logarithms.
template <class LogDensity>
double over_systematic(const LogDensity& log_density) {
  std::array<double, kSystematicParts.size()> logs{};
  for (std::size_t i = 0; i < logs.size(); ++i) logs[i] = log_density(i);
  const double largest = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(largest)) return kImpossible;
  double sum = 0.0;
  for (const double l : logs) sum += std::exp(l - largest);
  return largest + std::log(sum / static_cast<double>(logs.size()));
}

}  // namespace

// The error moves with the pose by [I, -[r]x], r being the dot's arm from the middle.
RigidFit::PoseNormal::PoseNormal(const RigidDot& dot, const Vector3d& middle_m,
                                 double systematic_m) {
  const Matrix3d covariance =
      dot.covariance_m2 + systematic_m * systematic_m * Matrix3d::Identity();
  const Matrix3d weight = covariance.inverse();
  const Vector3d arm = dot.arm_m - middle_m;
  const Vector3d pull = weight * dot.error_m;
  const Matrix3d turned = cross_columns(arm, weight);
  information.topLeftCorner<3, 3>() = weight;
  information.bottomLeftCorner<3, 3>() = turned;
  information.bottomRightCorner<3, 3>() = cross_columns(arm, turned.transpose());
  gradient << pull, arm.cross(pull);
  chi2 = dot.error_m.dot(pull);
  log_det = std::log(covariance.determinant());
}

RigidFit::PoseNormal& RigidFit::PoseNormal::operator+=(const PoseNormal& other) {
  information += other.information;
  gradient += other.gradient;
  chi2 += other.chi2;
  log_det += other.log_det;
  return *this;
}

RigidFit::RigidFit(std::span<const RigidDot> dots, double max_rms_residual_m)
    : middle_m_(middle_of(dots)) {
  static_assert(kSystematicParts.size() == kSystematic);
  for (const RigidDot& dot : dots) {
    auto& parts = dots_.emplace_back();
    for (std::size_t i = 0; i < kSystematic; ++i) {
      parts[i] = PoseNormal(dot, middle_m_, kSystematicParts[i] * max_rms_residual_m);
    }
  }
}

RigidFit::PoseNormal RigidFit::all_but(std::size_t dot, std::size_t systematic) const {
  PoseNormal sum;
  for (std::size_t i = 0; i < dots_.size(); ++i) {
    if (i != dot) sum += dots_[i][systematic];
  }
  return sum;
}

double RigidFit::log_density_of(const PoseNormal& normal, std::size_t dots) {
  const Eigen::LLT<Matrix6d> root(normal.information);
  if (root.info() != Eigen::Success) return kImpossible;
  const double chi2 = normal.chi2 - root.matrixL().solve(normal.gradient).squaredNorm();
  const double log_det = normal.log_det + 2.0 * std::log(root.matrixLLT().diagonal().prod());
  const auto freedom = 3.0 * static_cast<double>(dots) - 6.0;
  const double log_density = -0.5 * (chi2 + log_det + freedom * kLogTwoPi);
  return std::isfinite(log_density) ? log_density : kImpossible;
}

double RigidFit::log_density_of_all_but(std::size_t dot) const {
  const std::size_t dots = dots_.size() - (dot < dots_.size() ? 1 : 0);
  if (dots < 3) return kImpossible;
  return over_systematic([&](std::size_t i) { return log_density_of(all_but(dot, i), dots); });
}

bool RigidFit::best_step_without(std::size_t dot, RigidStep& step) const {
  const PoseNormal normal = all_but(dot, kTypical);
  const Eigen::LLT<Matrix6d> root(normal.information);
  if (!std::isfinite(normal.log_det) || root.info() != Eigen::Success) return false;
  const Vector6d best = root.solve(normal.gradient);
  step = {middle_m_, best.head<3>(), best.tail<3>()};
  return true;
}

double log_fit(std::span<const RigidDot> dots, double max_rms_residual_m) {
  return RigidFit(dots, max_rms_residual_m).log_density();
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
  return turns + over_systematic([&](std::size_t i) {
           const double systematic_m = kSystematicParts[i] * max_rms_residual_m;
           const double variance_m2 = own_m2 + 2.0 * systematic_m * systematic_m;
           return -0.5 * (off_m * off_m / variance_m2 + std::log(variance_m2) + kLogTwoPi);
         });
}

}  // namespace dottrack::acquisition
