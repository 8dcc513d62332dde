#pragma once
// Poses to hand over, by hand and at random.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <random>

#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "app/workstation/mavlink/ned_conversion.h"

namespace dottrack::workstation::testing {

inline void set_orientation(dottrack_pose& pose, const Eigen::Quaterniond& q) {
  pose.orientation_wxyz[0] = q.w();
  pose.orientation_wxyz[1] = q.x();
  pose.orientation_wxyz[2] = q.y();
  pose.orientation_wxyz[3] = q.z();
}

inline void set_covariance(dottrack_pose& pose, const Matrix6d& covariance) {
  pose.has_covariance = true;
  for (int i = 0; i < 36; ++i) pose.covariance[i] = covariance(i / 6, i % 6);
}

inline Eigen::Quaterniond yawed(double radians) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(radians, Eigen::Vector3d::UnitZ()));
}

// Valid, at the origin, level, along the world's x; nothing else is known.
inline dottrack_pose plain_pose() {
  dottrack_pose pose{};
  pose.state = DOTTRACK_TRACKING;
  pose.valid = true;
  pose.orientation_wxyz[0] = 1.0;
  pose.residual_m = -1.0;
  pose.false_lock_probability = -1.0;
  pose.arrival_us = 5'000'000;
  pose.age_us = 20'000;
  pose.reset_count = 1;
  return pose;
}

class RandomPoses {
 public:
  double number() { return normal_(engine_); }
  Eigen::Vector3d vector() { return {number(), number(), number()}; }
  Eigen::Quaterniond rotation() {
    return Eigen::Quaterniond(number(), number(), number(), number()).normalized();
  }
  Matrix6d covariance() {
    const Matrix6d root =
        Matrix6d::NullaryExpr([this](Eigen::Index, Eigen::Index) { return number(); });
    return root * root.transpose();
  }

 private:
  std::mt19937_64 engine_{20240617};
  std::normal_distribution<double> normal_;
};

}  // namespace dottrack::workstation::testing
