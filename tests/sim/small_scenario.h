#pragma once
// A scenario that renders in a moment: four cameras of 320 x 240 round a small sandbox.

#include <string>

namespace dottrack::test {

inline std::string small_scenario(const std::string& more = "") {
  return R"([scenario]
name = "small"
description = "a rover in a small sandbox"
ticks = 6

[hall]
length_m = 6.0
width_m = 5.0
rocks = 8
look_alikes = 3
lander = false
furniture = false
calibration_dots = 0

[cameras]
width_px = 320
height_px = 240

[[camera]]
name = "cam1"
at = [-2.6, -2.2, 3.4]
aim = [0.0, 0.0, 0.4]

[[camera]]
name = "cam2"
at = [2.6, -2.2, 3.4]
aim = [0.0, 0.0, 0.4]

[[camera]]
name = "cam3"
at = [2.6, 2.2, 3.4]
aim = [0.0, 0.0, 0.4]

[[camera]]
name = "cam4"
at = [-2.6, 2.2, 3.4]
aim = [0.0, 0.0, 0.4]

[sensor]
exposure_ms = 1.2

[motion]
kind = "drive"
way_points = [[-0.8, -0.5], [0.6, -0.5], [0.7, 0.6], [-0.7, 0.6]]
speed_m_s = 0.2

)" + more;
}

}  // namespace dottrack::test
