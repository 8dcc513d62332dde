#pragma once
// What the unit tells the bus once a tick: where the vehicle is, when, and how it knows.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/protocol/can_payload.h"
#include "app/core/reason.h"
#include "hal/base/camera_set.h"
#include "hal/base/time.h"

namespace dottrack::protocol {

struct PoseMessage {
  core::State state = core::State::acquiring;
  core::Reason reason = core::Reason::no_frames;
  CameraSet cameras_used;
  std::uint8_t dots_used = 0;
  std::uint8_t reset_count = 0;  // acquisitions so far, modulo 256
  Time mid_exposure{};           // whole microseconds on the bus, modulo 2^48 (8.9 years)
  bool pose_valid = false;       // false: position and orientation mean nothing
  bool out_of_range = false;     // there is a pose, but it does not fit into the message
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();             // T_world_vehicle
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // body to world, unit
};

struct PoseFrame {
  std::uint32_t id = 0;  // 11-bit identifier
  Payload data{};
};

// One message is a group of five frames: identifiers base_id to base_id + 4, in this order.
inline constexpr std::size_t kFramesPerPose = 5;
using PoseFrames = std::array<PoseFrame, kFramesPerPose>;

inline constexpr std::uint32_t kDefaultBaseId = 0x300;
inline constexpr std::uint32_t kLastBaseId = 0x7FF - kFramesPerPose + 1;
inline constexpr unsigned kProtocolVersion = 1;

}  // namespace dottrack::protocol
