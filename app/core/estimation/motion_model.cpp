#include "app/core/estimation/motion_model.h"

#include <cmath>
#include <numeric>

#include "app/core/estimation/rotation.h"

namespace dottrack::estimation {
namespace {

constexpr double squared(double x) {
  return x * x;
}

// Densities of white acceleration, m^2/s^3 and rad^2/s^3.
struct Noise {
  double translation = 0.0;
  double rotation = 0.0;
};

Noise of_accelerations(const core::MotionLimits& limits, double part, double hold_s) {
  return {squared(part * limits.max_acceleration_m_s2) * hold_s,
          squared(part * limits.max_turn_acceleration_rad_s2) * hold_s};
}

Noise noise_of(MotionModel model, const core::MotionLimits& limits, double seconds, double hold_s) {
  if (model == MotionModel::driven) return of_accelerations(limits, kDrivenPart, hold_s);
  if (model == MotionModel::eased) return of_accelerations(limits, kEasedPart, hold_s);
  if (model == MotionModel::steady) return of_accelerations(limits, kSteadyPart, hold_s);
  return {squared(kStruckPart * limits.max_speed_m_s) / seconds,
          squared(kStruckPart * limits.max_turn_rate_rad_s) / seconds};
}

Vector6d both(double translation, double rotation) {
  Vector6d v;
  v << translation, translation, translation, rotation, rotation, rotation;
  return v;
}

void rest(double seconds, MotionState& state) {
  state.velocity_m_s.setZero();
  state.rates_rad_s.setZero();
  Matrix12d& p = state.covariance;
  p.topRightCorner<6, 6>().setZero();
  p.bottomLeftCorner<6, 6>().setZero();
  p.bottomRightCorner<6, 6>() =
      both(squared(kRestSpeed_m_s), squared(kRestRate_rad_s)).asDiagonal();
  p.topLeftCorner<6, 6>().diagonal() +=
      std::abs(seconds) * both(squared(kTremor_m), squared(kTremor_rad));
}

// What a change of velocity and rates changes in the pose after `seconds`.
Matrix6d pose_by_motion(const Eigen::Matrix3d& body_to_world, const Eigen::Vector3d& rates_rad_s,
                        double seconds) {
  Matrix6d b = Matrix6d::Zero();
  b.topLeftCorner<3, 3>().diagonal().setConstant(seconds);
  b.bottomRightCorner<3, 3>() = seconds * body_to_world * left_jacobian(seconds * rates_rad_s);
  return b;
}

// P becomes F P F' with F = [I B; 0 I].
void carry_covariance(const Matrix6d& b, Matrix12d& p) {
  const Matrix6d by_motion = b * p.bottomRightCorner<6, 6>();
  const Matrix6d crossed = b * p.bottomLeftCorner<6, 6>();
  p.topLeftCorner<6, 6>() += crossed + crossed.transpose() + by_motion * b.transpose();
  p.topRightCorner<6, 6>() += by_motion;
  p.bottomLeftCorner<6, 6>() = p.topRightCorner<6, 6>().transpose();
}

// White acceleration over the time: the well-known t^3/3, t^2/2, t.
void add_noise(const Noise& noise, const Eigen::Matrix3d& body_to_world, double seconds,
               Matrix12d& p) {
  const Vector6d q = both(noise.translation, noise.rotation);
  const double t = std::abs(seconds);
  p.topLeftCorner<6, 6>().diagonal() += t * t * t / 3.0 * q;
  p.bottomRightCorner<6, 6>().diagonal() += t * q;
  const double half = 0.5 * seconds * t;
  p.block<3, 3>(0, 6).diagonal().array() += half * noise.translation;
  p.block<3, 3>(6, 0).diagonal().array() += half * noise.translation;
  p.block<3, 3>(3, 9) += half * noise.rotation * body_to_world;
  p.block<3, 3>(9, 3) += half * noise.rotation * body_to_world.transpose();
}

// Both triangles the same to the last bit.
void make_symmetric(Matrix12d& p) {
  for (Eigen::Index column = 0; column < p.cols(); ++column) {
    for (Eigen::Index row = 0; row < column; ++row) p(column, row) = p(row, column);
  }
}

void go_on(const Noise& noise, double seconds, MotionState& state) {
  const Eigen::Matrix3d body_to_world = state.orientation.toRotationMatrix();
  carry_covariance(pose_by_motion(body_to_world, state.rates_rad_s, seconds), state.covariance);
  add_noise(noise, body_to_world, seconds, state.covariance);
  make_symmetric(state.covariance);
  state.position_m += seconds * state.velocity_m_s;
  state.orientation = state.orientation * turn_by(seconds * state.rates_rad_s);
  state.orientation.normalize();
}

}  // namespace

ModelTable switching(double seconds) {
  ModelTable table = kSwitchesPerSecond;
  for (std::size_t from = 0; from < kMotionModels; ++from) {
    auto& row = table[from];
    const double sum = std::accumulate(row.begin(), row.end(), 0.0);
    const bool struck = from == static_cast<std::size_t>(MotionModel::struck);
    const double leaves = struck ? 1.0 : 1.0 - std::exp(-sum * seconds);
    for (double& p : row) p *= leaves / sum;
    row[from] = 1.0 - leaves;
  }
  return table;
}

void advance(MotionModel model, const core::MotionLimits& limits, double seconds,
             MotionState& state, double hold_s) {
  if (seconds == 0.0) return;
  state.at += std::chrono::round<Duration>(std::chrono::duration<double>(seconds));
  if (model == MotionModel::at_rest) return rest(seconds, state);
  go_on(noise_of(model, limits, std::abs(seconds), hold_s), seconds, state);
}

}  // namespace dottrack::estimation
