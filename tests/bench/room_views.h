#pragma once
// What the twelve cameras of the room see, as sightings: for measuring what comes after identify.

#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include "app/core/acquisition/match.h"
#include "app/core/image/identify.h"
#include "tests/bench/room_scene.h"

namespace dottrack::bench {

inline constexpr double kRoomDiameter_m = 0.1;

class RoomViews {
 public:
  // As many sightings in each camera: of dots in common, as far as it sees them, and others of its
  // own.
  RoomViews(std::size_t common_dots, std::size_t sightings);

  std::span<const acquisition::CameraView> views() const { return views_; }

 private:
  core::Rig rig_;
  std::mt19937 random_{11};
  std::vector<acquisition::CameraView> views_;
};

// The same as regions: of the target's dots at RoomScene's place and of others, each camera's own,
// that look like dots.
class RoomRegions {
 public:
  RoomRegions(const core::Rig& rig, std::size_t regions);

  std::span<const image::Regions* const> regions() const { return pointers_; }

 private:
  std::mt19937 random_{12};
  std::vector<image::Regions> regions_;
  std::vector<const image::Regions*> pointers_;
};

}  // namespace dottrack::bench
