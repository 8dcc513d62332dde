#pragma once
// How far poses are from the truth.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>

namespace dottrack::board {

inline constexpr double kWrongPosition_m = 0.1;
inline constexpr double kWrongAttitude_deg = 5.0;

struct PoseOf {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

double angle_between_deg(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b);

class TruthCheck {
 public:
  void add(const PoseOf& pose, const PoseOf& truth);

  std::size_t poses() const { return poses_; }
  std::size_t wrong() const { return wrong_; }  // further off than a pose may be
  double position_rms_m() const;
  double position_max_m() const { return position_max_m_; }
  double attitude_rms_deg() const;
  double attitude_max_deg() const { return attitude_max_deg_; }

 private:
  std::size_t poses_ = 0;
  std::size_t wrong_ = 0;
  double position_squares_ = 0.0;
  double attitude_squares_ = 0.0;
  double position_max_m_ = 0.0;
  double attitude_max_deg_ = 0.0;
};

}  // namespace dottrack::board
