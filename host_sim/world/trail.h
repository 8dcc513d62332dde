#pragma once
// The marks that the vehicle's wheels have left in the sand.

#include <Eigen/Core>
#include <vector>

#include "host_sim/world/drive_path.h"

namespace dottrack::host_sim {

class Trail {
 public:
  Trail() = default;
  // Where the vehicle's centre comes between two times; the wheels run `half_track_m` beside it.
  Trail(const DrivePath& drive, double from_s, double to_s, double half_track_m, double width_m);

  // How the tread changes the sand's albedo at a point: a factor, 1 beside the trail.
  double factor_at(const Eigen::Vector2d& p) const;

 private:
  std::vector<Eigen::Vector2d> centres_;  // close together, in order
  std::vector<double> along_m_;           // way from the first to each
  double half_track_m_ = 0.0;
  double width_m_ = 0.0;
};

}  // namespace dottrack::host_sim
