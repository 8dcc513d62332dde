#pragma once
// The MAVLink messages a pose becomes, each with its whole payload. Layouts, numbers and CRC_EXTRA
// are those of MAVLink's common.xml; on the wire fields go by size, extensions after them.
//
// ODOMETRY says MAV_FRAME_LOCAL_FRD and MAV_FRAME_BODY_FRD: the pair that both PX4 and ArduPilot
// take, and the true one, for dottrack's world need not point north. Its estimator is
// MAV_ESTIMATOR_TYPE_VISION, since PX4's EKF2 does not listen to MAV_ESTIMATOR_TYPE_MOCAP.

#include <cstdint>

#include "app/workstation/mavlink/mavlink_frame.h"
#include "app/workstation/mavlink/ned_conversion.h"

namespace dottrack::workstation {

struct VisionSample {
  std::uint64_t time_us = 0;  // middle of the exposure
  NedPose pose;
  std::uint8_t reset_counter = 0;  // a new value: the pose may have jumped
  std::int8_t quality = 0;         // percent: 1 worst, 100 best, 0 not known
};

MavlinkMessage heartbeat();                                           // #0
MavlinkMessage vision_position_estimate(const VisionSample& sample);  // #102
MavlinkMessage odometry(const VisionSample& sample);                  // #331

// From an upper bound of the probability that the pose is a false lock; negative: not known.
std::int8_t quality_percent(double false_lock_probability);

}  // namespace dottrack::workstation
