#pragma once
// One camera's sightings by place in the image.

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "app/core/acquisition/match.h"

namespace dottrack::acquisition {

// The paper's remedy for splintered sets: bounding boxes widened on each side.
inline constexpr double kWidenPart = 0.25;
inline constexpr double kWiden_px = 1.0;

class SightingIndex {
 public:
  void build(const CameraView& view);

  // The sighting closest to the pixel of all no further from it than radius_px whose widened
  // bounding box contains it and whose size is that of a dot at the point; kNone when there is
  // none.
  static constexpr std::uint16_t kNone = 0xFFFF;
  std::uint16_t closest(const Eigen::Vector2d& pixel, const Eigen::Vector3d& point_m,
                        double radius_px) const;

 private:
  static constexpr std::size_t kCells = 4096;

  void choose_cells(const core::Camera& camera, double mean_reach_px);
  int column(double x) const;
  int row(double y) const;

  const CameraView* view_ = nullptr;
  double cells_per_px_ = 0.0;
  double reach_px_ = 0.0;  // from a sighting's centre to the end of its widened box, at most
  int columns_ = 0;
  int rows_ = 0;
  std::array<std::uint16_t, kCells> heads_{};
  std::array<std::uint16_t, core::kMaxRegions> next_{};
  StaticVector<std::uint16_t, core::kMaxRegions> large_;  // that reach further
};

}  // namespace dottrack::acquisition
