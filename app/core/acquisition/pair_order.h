#pragma once
// Which pairs of cameras to match, so that nothing that k cameras see can be missed.
//
// Cameras are split into k - 1 groups and the pairs inside the groups are matched: of any k cameras
// two are in the same group. The fewer views of the room the cameras of a group share, the fewer
// crossings by chance there are to be looked at, so cameras that look at different places are put
// together.

#include <array>
#include <cstdint>
#include <span>

#include "app/core/acquisition/match.h"
#include "hal/base/camera_set.h"
#include "hal/base/static_vector.h"

namespace dottrack::acquisition {

struct CameraPair {
  std::uint8_t a = 0;
  std::uint8_t b = 0;  // above a

  bool operator==(const CameraPair&) const = default;
};

using CameraPairs = StaticVector<CameraPair, kMaxCameras*(kMaxCameras - 1) / 2>;

class PairOrder {
 public:
  // Of the cameras that have sightings. What the cameras share is measured when one has changed.
  void start(std::span<const CameraView> views);

  // Pairs in which every point shows that at least min_views of the cameras see from more than one
  // place, except those in `done` already (done[a] contains b); these count towards it.
  void list(int min_views, const std::array<CameraSet, kMaxCameras>& done, CameraPairs& pairs);

 private:
  using Groups = std::array<std::uint8_t, kMaxCameras>;  // of each camera in seeing_

  // What was found for as many views the last time: mostly the same cameras see something.
  struct Known {
    bool any = false;
    CameraSet seeing;
    std::array<CameraSet, kMaxCameras> done;
    Groups groups{};
  };

  void measure_overlap(std::span<const CameraView> views);
  void find_places(std::span<const CameraView> views);
  int cost_in(std::size_t camera, int group, const Groups& groups,
              const std::array<CameraSet, kMaxCameras>& done) const;
  Groups grouped(int groups, const std::array<CameraSet, kMaxCameras>& done) const;
  Groups groups_for(int min_views, const std::array<CameraSet, kMaxCameras>& done) const;
  int largest_miss(int count, const Groups& groups) const;

  std::array<geometry::CameraModel, kMaxCameras> measured_{};  // what overlap_ is true of
  std::size_t measured_count_ = 0;
  std::array<std::array<int, kMaxCameras>, kMaxCameras> overlap_{};
  std::array<std::uint8_t, kMaxCameras> place_{};  // cameras at one place have the same number
  CameraSet seeing_;
  std::array<Known, kMaxCameras + 1> known_;  // by min_views
};

}  // namespace dottrack::acquisition
