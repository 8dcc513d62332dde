#include "app/core/estimation/pose_information.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "app/core/estimation/rotation.h"

namespace dottrack::estimation {
namespace {

using Factor = Eigen::LLT<Matrix6d>;

// A direction in which the views know less than this part of what is known already is not seen.
constexpr double kUnseen = 1e-3;

Vector6d step_between(const Eigen::Vector3d& from_m, const Eigen::Quaterniond& from,
                      const Eigen::Vector3d& to_m, const Eigen::Quaterniond& to) {
  Vector6d step;
  step << to_m - from_m, rotation_vector(to * from.conjugate());
  return step;
}

// Information in units of the prior: L' information L, where the prior's covariance is L L'.
Matrix6d in_units_of(const Matrix6d& lower, const Matrix6d& information) {
  const Matrix6d half = information * lower;
  return lower.transpose() * half;
}

double log_determinant(const Factor& factor) {
  return 2.0 * factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

Vector6d gradient_at(const MotionState& state, const PoseInformation& views) {
  return views.gradient + views.information * step_between(state.position_m, state.orientation,
                                                           views.position_m, views.orientation);
}

void add(const PoseInformation& views, PoseInformation& sum) {
  sum.gradient +=
      views.gradient + views.information * step_between(sum.position_m, sum.orientation,
                                                        views.position_m, views.orientation);
  sum.information += views.information;
  sum.coordinates += views.coordinates;
}

// With P = [A C'; C B] and A = L L', the views' information I in those units is L' I L. Then
// (1 + L' I L) = K K', and W = [L; C L^-T], V = W K^-T: the new covariance is
// [0 0; 0 B - C A^-1 C'] + V V', a sum of what cannot be negative.
double take_in(const PoseInformation& views, MotionState& state) {
  Matrix12d& p = state.covariance;
  const Factor prior(p.topLeftCorner<6, 6>());
  const Matrix6d lower = prior.matrixL();
  const Factor gain(Matrix6d::Identity() + in_units_of(lower, views.information));

  Eigen::Matrix<double, 6, 12> w;  // transposed
  w.leftCols<6>() = lower.transpose();
  w.rightCols<6>() = p.topRightCorner<6, 6>();
  prior.matrixL().solveInPlace(w.rightCols<6>());
  p.bottomRightCorner<6, 6>() -= w.rightCols<6>().transpose() * w.rightCols<6>();
  p.topLeftCorner<6, 6>().setZero();
  p.topRightCorner<6, 6>().setZero();
  p.bottomLeftCorner<6, 6>().setZero();
  Eigen::Matrix<double, 6, 12> v = w;
  gain.matrixL().solveInPlace(v);
  p += v.transpose() * v;

  const Vector6d apart =
      step_between(state.position_m, state.orientation, views.position_m, views.orientation);
  const Vector6d informed = views.information * apart;
  Vector6d pull = lower.transpose() * (views.gradient + informed);
  gain.matrixL().solveInPlace(pull);
  move_by(v.transpose() * pull, state);
  return 0.5 * (pull.squaredNorm() - log_determinant(gain) - apart.dot(informed)) -
         apart.dot(views.gradient);
}

double surprise(const Matrix6d& information, const Vector6d& gradient, const Matrix6d& covariance) {
  const Matrix6d lower = Factor(covariance).matrixL();
  Matrix6d units = in_units_of(lower, information);
  const Vector6d pull = lower.transpose() * gradient;
  const Vector6d explained = Factor(Matrix6d::Identity() + units).solve(pull);
  units.diagonal().array() += kUnseen;
  return pull.dot(Factor(units).solve(explained));
}

double largest_surprise(int coordinates) {
  constexpr std::array<double, 6> kOnceInAMillion{23.93, 27.63, 30.66, 33.38, 35.89, 38.26};
  return kOnceInAMillion[static_cast<std::size_t>(std::clamp(coordinates, 1, 6) - 1)];
}

}  // namespace dottrack::estimation
