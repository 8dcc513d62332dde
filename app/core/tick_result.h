#pragma once
// Everything the tracker knows after one tick: plain data of fixed size.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "app/core/dot_flaw.h"
#include "app/core/limits.h"
#include "app/core/reason.h"
#include "hal/base/camera_set.h"
#include "hal/base/time.h"

namespace dottrack::core {

struct Pose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();             // T_world_vehicle
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // body to world, unit
  // x y z roll pitch yaw: metres and radians, world frame, rotations about the world axes.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double rms_residual_m = 0.0;  // of the triangulated dots against the target in this pose
};

// How the vehicle moves, from all ticks of a lock.
struct Motion {
  bool known = false;                                      // the lock has two ticks and more
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();  // of the vehicle's origin, world axes
  Eigen::Vector3d rates_rad_s = Eigen::Vector3d::Zero();   // vehicle axes
};

// What the filter over time makes of it.
struct FilteredPose {
  bool known = false;
  bool coasting = false;  // no pose was found in this tick: by the vehicle's motion alone
  Pose pose;              // its rms_residual_m means nothing
  Motion motion;
  // Velocity (m/s, world axes), then rates (rad/s, vehicle axes).
  Eigen::Matrix<double, 6, 6> motion_covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

// How one camera saw one dot.
struct DotView {
  bool seen = false;  // in its place; whether it is used or not
  bool used = false;
  DotFlaw flaw = DotFlaw::none;
  bool bloomed = false;  // charge has spilt along its columns: its centre is not where it seems
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();
  float semi_major_px = 0.0F;
  float semi_minor_px = 0.0F;
  float angle_rad = 0.0F;
  float residual_px = 0.0F;          // from where the pose puts it
  float normalised_residual = 0.0F;  // the same in its own standard deviations: 1 on average
};

struct DotState {
  bool located = false;  // triangulated from at least two cameras in this tick
  // World: as triangulated; where the pose puts it if a single camera saw it.
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double position_sigma_m = 0.0;  // root of the covariance's trace
  double diameter_m = 0.0;        // as measured
  CameraSet cameras;              // that saw it
  std::array<DotView, kMaxCameras> views{};
};

// What one camera's image came to in this tick.
struct CameraTick {
  bool delivered = false;
  bool used = false;                 // contributes at least one view to the pose
  std::uint32_t regions = 0;         // accepted by identify
  std::uint32_t components = 0;      // before the gates
  std::uint32_t rejected_size = 0;   // of the components: not a dot's size
  std::uint32_t rejected_shape = 0;  // not a dot's shape
  std::uint32_t rejected_sight = 0;  // of the regions: at the border, or no dot could be seen so
  std::uint32_t sightings = 0;       // of the regions: taken into matching
  // While tracking: regions in a dot's place that do not have the shape of that dot.
  std::uint32_t rejected_ellipse = 0;
  // Of the regions in a dot's place, those that blooming has grown, taken for the dot or not.
  std::uint32_t bloomed = 0;
  bool overflow = false;  // a capacity was reached: some regions were left out
  bool stale = false;     // delivered the picture of the tick before again: left out
  bool moved = false;     // stands no longer as its model says: left out
  // How far its dots are off, all alike, from where the other cameras say they are; over the last
  // ticks, zero where it sees too little.
  Eigen::Vector2f shift_px = Eigen::Vector2f::Zero();
};

// How many candidates each gate of acquisition left over (paper 3.1.2 to 3.1.5).
struct AcquisitionCounts {
  // Of sightings in two cameras that no coarse look ruled out; what the gates refused of them.
  std::uint32_t pairs_tested = 0;
  std::uint32_t rejected_collinear = 0;
  std::uint32_t rejected_behind = 0;
  std::uint32_t rejected_distance = 0;
  std::uint32_t rejected_miss = 0;
  std::uint32_t rejected_size = 0;
  std::uint32_t rejected_reprojection = 0;
  std::uint32_t pairs_accepted = 0;
  std::uint32_t finalists = 0;
  std::uint32_t overflow = 0;     // pairs or finalists beyond capacity
  std::uint64_t work_units = 0;   // of this tick
  std::uint32_t ticks = 0;        // that this search has taken so far
  std::uint8_t min_views = 0;     // cameras that every finalist of the selection was asked to have
  std::uint8_t dots_matched = 0;  // of the best selection; 0: there was none
  // Of the best selection, in the light of all ticks so far; 1: there was none.
  double false_lock_probability = 1.0;
};

// Why a lock was exchanged for another without having been lost.
enum class Relock : std::uint8_t {
  none = 0,
  better_elsewhere = 1,  // acquisition found a better explanation of the images at another place
  jumped = 2,            // the vehicle is where it cannot have come by itself
};

struct TickResult {
  std::uint64_t tick = 0;
  Time capture_time{};  // middle of the exposure; of the tick's frames, their mean
  State state = State::acquiring;
  Reason reason = Reason::no_frames;
  Relock relock = Relock::none;  // of this tick
  bool has_pose = false;
  Pose pose;  // from the images of this tick alone
  // The part of its covariance that comes from the camera models and the dots' places on the
  // target: the same from tick to tick.
  Eigen::Matrix<double, 6, 6> systematic = Eigen::Matrix<double, 6, 6>::Zero();
  double dot_sigma_m = 0.0;  // of these places, each coordinate: known beforehand or learnt
  FilteredPose filtered;     // at the same instant; while coasting without a pose beside it
  double false_lock_probability = 1.0;  // that the lock is a wrong one, at most; with a pose only
  std::uint32_t reset_count = 0;        // acquisitions so far: a new value is a new lock
  std::uint32_t ticks_lost = 0;         // consecutive ticks without a pose
  CameraSet cameras_used;
  std::uint8_t dots_used = 0;
  std::uint16_t views_used = 0;
  std::uint16_t views_left_out = 0;  // seen in a dot's place, but at odds with the others
  bool rig_disagrees = false;        // more cameras contradict each other than can be left out
  bool has_candidate = false;
  std::array<DotState, kMaxDots> dots{};
  std::array<CameraTick, kMaxCameras> cameras{};
  AcquisitionCounts acquisition;
  // Where has_candidate: the pose of acquisition's best selection in this tick, even if it is held
  // back; the one that `acquisition.false_lock_probability` speaks of.
  Pose candidate;
};

}  // namespace dottrack::core
