#pragma once
// Poses in the units and words that people read.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "hal/base/time.h"

namespace dottrack::monitor {

struct RollPitchYaw {
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double yaw_deg = 0.0;
};

// First yaw about z, then pitch about the new y, then roll about the new x: vehicle forward, left,
// up. Looking straight up or down, roll is 0 and yaw has it all.
RollPitchYaw roll_pitch_yaw(const double (&orientation_wxyz)[4]);

// Standard deviations: x y z in metres, then roll pitch yaw in radians; nothing if not known.
std::optional<std::array<double, 6>> sigmas(const dottrack_pose& pose);

// Nothing where the unit did not say, or it is beyond all measure.
std::optional<double> age_s(const dottrack_pose& pose);

// "camera_missing few_cameras"; "-" for none.
std::string degraded_words(std::uint16_t degraded);

// One bit a camera, from camera 1 on: "1-4,7"; "-" for none.
std::string camera_numbers(std::uint16_t cameras);

// "used 1-4, no_frame 5"; cameras that the rig does not have are left out.
std::string health_words(const dottrack_pose& pose);

// "steady 1-6, too_dark 7; iris ok 1-6, at_end 7"; cameras that nothing was told of are left out.
// Empty where that is all of them.
std::string light_words(std::span<const dottrack_light> lights);

// "fresh"; of a group that is sound but has no pose, "fresh, no pose".
std::string verdict_words(dottrack_verdict verdict, const dottrack_pose* pose);

// "0.1.0, protocol 2, configuration 1A2B3C4D, target 0, 8 cameras"; "not told yet".
std::string unit_words(const dottrack_unit& unit);

// Seconds with six decimals.
std::string seconds_text(Duration time);

}  // namespace dottrack::monitor
