#pragma once
// What the unit tells the bus: where the vehicle is, when, how it knows, and how well.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/core/limits.h"
#include "app/core/protocol/degraded.h"
#include "app/core/reason.h"
#include "hal/base/camera_set.h"
#include "hal/base/time.h"

namespace dottrack::protocol {

inline constexpr unsigned kProtocolVersion = 2;

enum class CameraHealth : std::uint8_t {
  absent = 0,    // the rig has no such camera
  used = 1,      // the pose rests on it, too
  unused = 2,    // delivers, but sees nothing of the target
  no_frame = 3,  // delivered nothing in this tick
  stale = 4,     // delivered the picture of the tick before again
  overflow = 5,  // sees more regions than there is room for
  iris_fault = 6,
  moved = 7,  // stands no longer as its model says: left out
};

enum class PoseKind : std::uint8_t {
  measured = 0,   // from the pictures of one instant alone
  filtered = 1,   // from the pictures before, too
  predicted = 2,  // carried on to the moment of sending
  coasting = 3,   // by the motion alone: the target is not seen
};

enum class Visibility : std::uint8_t { not_seen = 0, one_camera = 1, located = 2 };

struct DotReport {
  Visibility visibility = Visibility::not_seen;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // world; means nothing when not seen
  double sigma_m = 0.0;                                  // root of the covariance's trace
  CameraSet cameras;                                     // that see it
};

struct PoseMessage {
  core::State state = core::State::acquiring;
  core::Reason reason = core::Reason::no_frames;
  CameraSet cameras_used;
  std::uint8_t dots_used = 0;
  std::uint8_t reset_count = 0;  // locks so far, modulo 256
  DegradedSet degraded;
  Time mid_exposure{};  // when the pose holds; whole microseconds on the bus, modulo 2^48 (8.9
                        // years)
  Duration age{};       // from the middle of the exposure until now

  PoseKind kind = PoseKind::measured;
  bool pose_valid = false;  // false: nothing below means anything but dots and cameras
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();             // T_world_vehicle
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // body to world, unit
  double residual_m = 0.0;                                          // RMS
  double false_lock_probability = 1.0;                              // an upper bound
  // x y z roll pitch yaw: metres and radians, world frame, rotations about the world axes.
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;
  std::optional<Eigen::Vector3d> velocity_m_s;  // world axes
  std::optional<Eigen::Vector3d> rates_rad_s;   // vehicle axes

  std::uint8_t dots_known = 0;  // of the target
  std::array<DotReport, core::kMaxDots> dots{};
  std::array<CameraHealth, kMaxCameras> cameras{};
};

// What stays the same from group to group.
struct IdentityMessage {
  std::uint8_t major = 0;
  std::uint8_t minor = 0;
  std::uint8_t patch = 0;
  Duration group_period{};
  std::uint32_t config_hash = 0;
  std::uint8_t target = 0;   // which of the rig's, from 0
  std::uint8_t cameras = 0;  // of the rig
};

}  // namespace dottrack::protocol
