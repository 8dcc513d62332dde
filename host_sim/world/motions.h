#pragma once
// Ways to move. All pure functions of time, seconds; before 0 they stand where they are at 0.

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "host_sim/world/motion.h"
#include "host_sim/world/terrain.h"

namespace dottrack::host_sim {

using WayPoints = std::vector<Eigen::Vector2d>;  // two or more, no two successive ones equal

// Of the smooth curve through the way points, seen from above.
double path_length_m(const WayPoints& way_points, bool closed);
double distance_to_path_m(const WayPoints& way_points, bool closed, const Eigen::Vector2d& p);

// The vehicle's wheels on the ground (as well as six wheels of a stiff vehicle can stand on it),
// heading `yaw_rad` from world x.
Pose placed_on(const Terrain& terrain, const Eigen::Vector2d& position_m, double yaw_rad);

// The vehicle along the smooth curve, heading along it; `speed_m_s` is seen from above. Stops at
// the last way point, or begins again where the curve is closed.
Motion drive_along(const Terrain& terrain, const WayPoints& way_points, double speed_m_s,
                   bool closed);

Motion stand_at(const Pose& pose);

// One place after the other, `dwell_s` each, moved at once in between; stays at the last.
Motion survey_places(std::vector<Pose> places, double dwell_s);

// Moved by a crane in a straight line at constant speed. It dangles: an offset to the sides of up
// to 1.5 vibration_m, at 0.7 and 1.3 Hz, and the tilt of a pendulum with these periods.
struct CraneLine {
  Eigen::Vector3d from_m;
  Eigen::Vector3d to_m;
  double speed_m_s = 0.1;
  double yaw_rad = 0.0;
  double vibration_m = 0.003;
};
struct LineTimes {
  double from_s;
  double to_s;
};
// When each line is run: one after the other without a pause. Where the next does not begin at the
// end of the last, the body is moved at once.
std::vector<LineTimes> crane_line_times(const std::vector<CraneLine>& lines);
Motion crane_lines(std::vector<CraneLine> lines);
Motion crane_line(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, double speed_m_s,
                  double yaw_rad, double vibration_m);

// From each time on, the motion beside it (asked for the same time, not for the time since); an
// empty one: not there. Nothing before the first. Times ascend.
Motion switched(std::vector<std::pair<double, Motion>> motions);

// Somebody on foot: upright, facing ahead, with a bob and a sway of some centimetres.
Motion walk(const Terrain& terrain, const WayPoints& way_points, double speed_m_s, bool closed);

}  // namespace dottrack::host_sim
