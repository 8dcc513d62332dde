#pragma once
// A vehicle that rests, drives and brakes at random within its limits, and cameras that see its
// pose. Its motion is integrated in small steps of its own, not by the filter's equations.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <random>
#include <utility>
#include <vector>

#include "app/core/estimation/motion_model.h"
#include "app/core/estimation/motion_state.h"
#include "app/core/estimation/pose_information.h"

namespace dottrack::estimation {

using Random = std::mt19937_64;

struct Truth {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d rates_rad_s = Eigen::Vector3d::Zero();  // vehicle axes
};

Eigen::Vector3d normal_vector(Random& random, double sigma);

// Moves as the table of switches says; accelerations are drawn anew every kAccelerationHolds_s.
class MovingVehicle {
 public:
  MovingVehicle(const core::MotionLimits& limits, std::uint64_t seed);

  // Only this way from now on.
  void keep(MotionModel model);
  void hold_still() { still_ = true; }  // at rest, and not even a tremor
  void advance_to(double time_s);
  const Truth& truth() const { return truth_; }
  MotionModel model() const { return model_; }

 private:
  void choose_model(double seconds);
  void brake(double seconds);
  void accelerate(double seconds);
  Eigen::Vector3d limited(double part, double limit);

  core::MotionLimits limits_;
  Random random_;
  Truth truth_;
  MotionModel model_ = MotionModel::at_rest;
  bool braking_ = false;  // to be at rest
  bool kept_ = false;
  bool still_ = false;
  double now_s_ = 0.0;
  double held_s_ = 0.0;
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_acceleration_ = Eigen::Vector3d::Zero();
};

// A camera: so many coordinates of a pose, each a random direction in it.
PoseInformation look(const Truth& truth, Time captured, int coordinates, double sigma,
                     Random& random);

// Translation, rotation, velocity and rates from the state to the truth.
Vector12d error_of(const MotionState& state, const Truth& truth);
double normalised_squared_error(const MotionState& state, const Truth& truth);

}  // namespace dottrack::estimation
