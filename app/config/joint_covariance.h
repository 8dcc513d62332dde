#pragma once
// The covariance of all cameras' models together, as a calibration of all of them leaves it: S of
// each camera's file and what S does not say, how the errors of different cameras go together.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "hal/base/result.h"

namespace dottrack::config {

// What the file is called beside the models.
inline constexpr const char* kJointCovarianceFile = "joint_covariance.csv";

struct JointCovariance {
  struct Camera {
    std::string name;
    Eigen::Index first = 0;  // row of its C_x
    Eigen::Index size = 0;   // 12, 18 or 21 rows: C A H V [O R [E]]
  };

  std::vector<Camera> cameras;
  Eigen::MatrixXd covariance;  // symmetric

  const Camera* find(const std::string& name) const;
  // Of the vectors of two cameras, or of one.
  Eigen::MatrixXd block(const Camera& row, const Camera& column) const {
    return covariance.block(row.first, column.first, row.size, column.size);
  }
};

// CSV, a line a row: the camera's name, then the row up to its diagonal. An error names line and
// what was expected; `name` stands for the file.
Result<JointCovariance> parse_joint_covariance(const std::string& text, const std::string& name);

// Ten digits of each number.
std::string write_joint_covariance(const JointCovariance& joint);

}  // namespace dottrack::config
