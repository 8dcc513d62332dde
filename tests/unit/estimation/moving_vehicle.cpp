#include "tests/unit/estimation/moving_vehicle.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace dottrack::estimation {
namespace {

using Eigen::Vector3d;

constexpr double kStep_s = 0.001;
constexpr double kLever_m = 0.5;  // so far from the origin a rotation of 1 rad is a displacement of

Eigen::Quaterniond turned(const Vector3d& v) {
  const double angle = v.norm();
  return angle > 0.0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, v / angle))
                     : Eigen::Quaterniond::Identity();
}

Vector3d turn_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  const Eigen::AngleAxisd turn(to * from.conjugate());
  const double angle = turn.angle() > M_PI ? turn.angle() - 2.0 * M_PI : turn.angle();
  return angle * turn.axis();
}

// About a second in each way of moving.
std::array<double, kMotionModels> changes(double seconds, MotionModel from) {
  constexpr ModelTable kPerSecond{{
      {0.0, 0.0, 0.4, 0.5, 0.0},
      {0.0, 0.0, 0.5, 0.5, 0.0},
      {0.2, 0.5, 0.0, 0.5, 0.0},
      {0.2, 0.5, 0.5, 0.0, 0.0},
      {0.0, 0.0, 0.0, 0.0, 0.0},
  }};
  auto row = kPerSecond[static_cast<std::size_t>(from)];
  double stays = 1.0;
  for (double& p : row) stays -= p *= seconds;
  row[static_cast<std::size_t>(from)] = stays;
  return row;
}

// What is fast already does not become faster.
Vector3d towards_slow(const Vector3d& acceleration, const Vector3d& velocity, double limit) {
  const bool faster = velocity.norm() > 0.8 * limit && acceleration.dot(velocity) > 0.0;
  return faster ? Vector3d(-acceleration) : acceleration;
}

Vector3d braking(const Vector3d& velocity, double limit, double seconds) {
  const double speed = velocity.norm();
  return -velocity / std::max(speed / limit, seconds);
}

double part_of(MotionModel model) {
  if (model == MotionModel::steady) return kSteadyPart;
  return model == MotionModel::eased ? kEasedPart : kDrivenPart;
}

}  // namespace

Vector3d normal_vector(Random& random, double sigma) {
  std::normal_distribution<double> normal(0.0, sigma);
  const double x = normal(random);
  const double y = normal(random);
  return {x, y, normal(random)};
}

MovingVehicle::MovingVehicle(const core::MotionLimits& limits, std::uint64_t seed)
    : limits_(limits), random_(seed) {
  truth_.position_m = normal_vector(random_, 2.0);
  truth_.orientation = turned(normal_vector(random_, 1.0));
}

void MovingVehicle::keep(MotionModel model) {
  model_ = model;
  kept_ = true;
  held_s_ = 0.0;
}

void MovingVehicle::choose_model(double seconds) {
  if (kept_ || braking_) return;
  std::uniform_real_distribution<double> uniform;
  const auto row = changes(seconds, model_);
  double left = uniform(random_);
  for (std::size_t i = 0; i < kMotionModels; ++i) {
    left -= row[i];
    if (left < 0.0) {
      if (i != static_cast<std::size_t>(model_)) held_s_ = 0.0;
      const auto next = static_cast<MotionModel>(i);
      braking_ = next == MotionModel::at_rest && model_ != next;
      model_ = braking_ ? MotionModel::driven : next;
      return;
    }
  }
}

Vector3d MovingVehicle::limited(double part, double limit) {
  Vector3d drawn = normal_vector(random_, part * limit);
  return drawn.norm() > limit ? Vector3d(drawn * (limit / drawn.norm())) : drawn;
}

// As hard as it can, to the very end.
void MovingVehicle::brake(double seconds) {
  acceleration_ = braking(truth_.velocity_m_s, limits_.max_acceleration_m_s2, seconds);
  turn_acceleration_ = braking(truth_.rates_rad_s, limits_.max_turn_acceleration_rad_s2, seconds);
  if (truth_.velocity_m_s.norm() > 1e-9 || truth_.rates_rad_s.norm() > 1e-9) return;
  model_ = MotionModel::at_rest;
  braking_ = false;
}

void MovingVehicle::accelerate(double seconds) {
  if (braking_) return brake(seconds);
  held_s_ -= seconds;
  if (held_s_ > 0.0) return;
  held_s_ = kAccelerationHolds_s;
  const double part = part_of(model_);
  acceleration_ = towards_slow(limited(part, limits_.max_acceleration_m_s2), truth_.velocity_m_s,
                               limits_.max_speed_m_s);
  turn_acceleration_ = towards_slow(limited(part, limits_.max_turn_acceleration_rad_s2),
                                    truth_.rates_rad_s, limits_.max_turn_rate_rad_s);
}

void MovingVehicle::advance_to(double time_s) {
  while (now_s_ < time_s - 1e-9) {
    const double dt = std::min(kStep_s, time_s - now_s_);
    now_s_ += dt;
    choose_model(dt);
    if (model_ == MotionModel::at_rest) {
      truth_.velocity_m_s.setZero();
      truth_.rates_rad_s.setZero();
      if (still_) continue;
      truth_.position_m += normal_vector(random_, kTremor_m * std::sqrt(dt));
      truth_.orientation =
          turned(normal_vector(random_, kTremor_rad * std::sqrt(dt))) * truth_.orientation;
      continue;
    }
    if (model_ == MotionModel::struck) {
      truth_.velocity_m_s += normal_vector(random_, kStruckPart * limits_.max_speed_m_s);
      truth_.rates_rad_s += normal_vector(random_, kStruckPart * limits_.max_turn_rate_rad_s);
      continue;
    }
    accelerate(dt);
    truth_.position_m += dt * truth_.velocity_m_s + 0.5 * dt * dt * acceleration_;
    truth_.orientation =
        truth_.orientation * turned(dt * truth_.rates_rad_s + 0.5 * dt * dt * turn_acceleration_);
    truth_.velocity_m_s += dt * acceleration_;
    truth_.rates_rad_s += dt * turn_acceleration_;
  }
}

PoseInformation look(const Truth& truth, Time captured, int coordinates, double sigma,
                     Random& random) {
  PoseInformation views;
  views.captured = captured;
  views.position_m = truth.position_m + normal_vector(random, sigma);
  views.orientation = turned(normal_vector(random, sigma / kLever_m)) * truth.orientation;
  Vector6d to_truth;
  to_truth << truth.position_m - views.position_m,
      turn_between(views.orientation, truth.orientation);
  std::normal_distribution<double> normal;
  for (int i = 0; i < coordinates; ++i) {
    Vector6d row;
    row << normal_vector(random, 1.0).normalized(),
        kLever_m * normal_vector(random, 1.0).normalized();
    row /= sigma;
    views.information += row * row.transpose();
    views.gradient += row * (row.dot(to_truth) + normal(random));
  }
  views.coordinates = coordinates;
  return views;
}

Vector12d error_of(const MotionState& state, const Truth& truth) {
  Vector12d error;
  error << truth.position_m - state.position_m, turn_between(state.orientation, truth.orientation),
      truth.velocity_m_s - state.velocity_m_s, truth.rates_rad_s - state.rates_rad_s;
  return error;
}

double normalised_squared_error(const MotionState& state, const Truth& truth) {
  const Vector6d error = error_of(state, truth).head<6>();
  const Matrix6d covariance = state.covariance.topLeftCorner<6, 6>();
  return error.dot(covariance.llt().solve(error));
}

}  // namespace dottrack::estimation
