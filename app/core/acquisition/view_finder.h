#pragma once
// Which sightings a point in space may be, in every camera at once.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "app/core/acquisition/match.h"
#include "app/core/acquisition/point_filter.h"
#include "app/core/acquisition/sighting_index.h"
#include "hal/base/camera_set.h"

namespace dottrack::acquisition {

// At most one sighting a camera.
struct PointViews {
  CameraSet cameras;
  std::array<std::uint16_t, kMaxCameras> sighting{};  // where cameras has it

  void set(std::size_t camera, std::uint16_t index) {
    cameras.insert(camera);
    sighting[camera] = index;
  }
};

bool same_views(const PointViews& a, const PointViews& b);

class ViewFinder {
 public:
  void start(std::span<const CameraView> views);

  // Every camera that has a sighting within kClose_px of the point's projection, and some others.
  CameraSet look(const Eigen::Vector3d& point_m) const { return filter_.look(point_m); }
  void look(std::span<const CandidatePair> pairs, std::span<CameraSet> close) const {
    filter_.look(pairs, close);
  }

  // In each of these cameras the sighting closest to the point's projection, of those no further
  // from it than radius_px whose widened box contains it and whose size fits the point's range.
  // `known` views are taken as they are. Stops when fewer than `enough` cameras can be reached;
  // what it has found until then is what it returns.
  PointViews views_of(const Eigen::Vector3d& point_m, CameraSet cameras, double radius_px,
                      const PointViews& known = {}, int enough = 0) const;
  PointViews close_views(const Eigen::Vector3d& point_m) const;

  // The pair's lines of sight are so close to parallel that their crossing says little of where
  // other cameras see the dot.
  bool is_vague(const CandidatePair& pair) const;

  CameraSet seeing() const { return seeing_; }

 private:
  PointFilter filter_;
  std::span<const CameraView> views_;
  std::array<SightingIndex, kMaxCameras> index_;
  std::array<Eigen::Vector3d, kMaxCameras> centres_m_;
  CameraSet seeing_;
};

}  // namespace dottrack::acquisition
