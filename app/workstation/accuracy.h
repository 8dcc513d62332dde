#pragma once
// How far reported poses are from the truth.

#include <cstdint>
#include <span>

#include "app/workstation/tum_reader.h"

namespace dottrack::workstation {

// A pose further off than one of these is a wrong lock.
inline constexpr double kWrongLock_mm = 100.0;
inline constexpr double kWrongLock_deg = 5.0;

struct Accuracy {
  std::uint64_t compared = 0;
  std::uint64_t without_truth = 0;     // poses at a time of which there is no truth
  std::uint64_t wrong_lock_ticks = 0;  // among those compared; their errors count below, too
  double position_rms_mm = 0.0;
  double position_max_mm = 0.0;
  double attitude_rms_deg = 0.0;  // angle of the rotation between the two
  double attitude_max_deg = 0.0;
};

// Both in order of time. Times agree when they are within 1 ms.
Accuracy compare(std::span<const TimedPose> poses, std::span<const TimedPose> truth);

}  // namespace dottrack::workstation
