#pragma once
// Which sightings a point in space may be, in every camera at once.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "app/core/acquisition/match.h"
#include "hal/base/camera_set.h"

namespace dottrack::acquisition {

// The paper's remedy for splintered sets: bounding boxes widened on each side.
inline constexpr double kWidenPart = 0.25;
inline constexpr double kWiden_px = 1.0;

// At most one sighting a camera.
struct PointViews {
  CameraSet cameras;
  std::array<std::uint16_t, kMaxCameras> sighting{};  // where cameras has it

  void set(std::size_t camera, std::uint16_t index) {
    cameras.insert(camera);
    sighting[camera] = index;
  }
  bool sees(std::size_t camera, std::size_t index) const {
    return cameras.contains(camera) && sighting[camera] == index;
  }
};

bool same_views(const PointViews& a, const PointViews& b);

// One camera's sightings by place in the image.
class SightingIndex {
 public:
  void build(const CameraView& view);

  // The sighting closest to the pixel of all whose widened bounding box contains it and whose size
  // is that of a dot at the point; kNone when there is none.
  static constexpr std::uint16_t kNone = 0xFFFF;
  std::uint16_t closest(const Eigen::Vector2d& pixel, const Eigen::Vector3d& point_m) const;

 private:
  // What it takes to judge a sighting, on one cache line.
  struct Outline {
    Eigen::Vector2d min_px;  // of the widened box
    Eigen::Vector2d max_px;
    Eigen::Vector2d pixel;
    double near_m = 0.0;
    double far_m = 0.0;
  };
  struct Entry {
    std::uint16_t sighting;
    std::uint16_t next;
  };

  static constexpr std::size_t kCells = 4096;
  static constexpr std::size_t kEntries = 8 * core::kMaxRegions;

  void choose_cells(const CameraView& view);
  void insert(std::uint16_t sighting);
  int column(double x) const;
  int row(double y) const;
  void judge(std::uint16_t sighting, const Eigen::Vector2d& pixel, const Eigen::Vector3d& point_m,
             double& least2, std::uint16_t& best) const;

  const CameraView* view_ = nullptr;
  double cells_per_px_ = 0.0;
  int columns_ = 0;
  int rows_ = 0;
  std::array<std::uint16_t, kCells> heads_{};
  StaticVector<Entry, kEntries> entries_;
  StaticVector<std::uint16_t, core::kMaxRegions> large_;  // over too many cells to be entered
  std::array<Outline, core::kMaxRegions> outlines_;
};

class ViewFinder {
 public:
  void start(std::span<const CameraView> views);

  // The closest sighting in every camera whose widened box contains the point's projection and
  // whose size fits the point's range; `known` views are taken as they are. Stops when fewer than
  // `enough` cameras can be reached; what it has found until then is what it returns.
  PointViews views_of(const Eigen::Vector3d& point_m, int enough,
                      const PointViews& known = {}) const;

 private:
  std::span<const CameraView> views_;
  std::array<SightingIndex, kMaxCameras> index_;
  CameraSet seeing_;
};

}  // namespace dottrack::acquisition
