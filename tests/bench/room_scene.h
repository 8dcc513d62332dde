#pragma once
// Twelve ceiling cameras over a room with a target and clutter in it: 22 x 9 m and 5 m high, as the
// paper's (section 4). A scene for measuring speed; accuracy is the simulator's business.

#include <Eigen/Geometry>
#include <array>
#include <random>

#include "app/core/tracker.h"
#include "tests/bench/blob_scene.h"

namespace dottrack::bench {

inline constexpr std::size_t kRoomCameras = 12;

// Twelve CAHVOR cameras of 640 x 480, and a target of n dots of 10 cm.
core::Rig room_rig(std::size_t dots);

// Points between the floor and a metre above it.
Eigen::Vector3d point_in_room(std::mt19937& random);

class RoomScene {
 public:
  // The target stands in the middle; bright discs of a dot's size lie about; every image has the
  // clutter of the heavy set.
  explicit RoomScene(std::size_t dots);

  const core::Rig& rig() const { return rig_; }
  std::array<core::CameraFrame, kMaxCameras> frames() const;
  // Where the target's origin is.
  static Eigen::Vector3d place_m() { return {11.0, 4.5, 0.3}; }

 private:
  void paint_disc(std::size_t camera, const Eigen::Vector3d& place_m, double diameter_m);

  core::Rig rig_;
  PictureSet pictures_;
  std::mt19937 random_{7};
};

}  // namespace dottrack::bench
