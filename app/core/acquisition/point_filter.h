#pragma once
// A coarse look at a point in space through all cameras at once: which of them may have a sighting
// close to where it projects to.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/core/acquisition/match.h"
#include "hal/base/camera_set.h"

namespace dottrack::acquisition {

// Sightings this close to a point's projection are close, pixels.
inline constexpr double kClose_px = 3.0;

// Projects with single precision, many cameras at a time, and looks into a map of the image with a
// bit for every few pixels. Cameras of the CAHVORE model, which takes iterations to project, are
// taken to be close to everything.
class PointFilter {
 public:
  void start(std::span<const CameraView> views);

  // Every camera that has a sighting within kClose_px of the point's projection, and some others.
  CameraSet look(const Eigen::Vector3d& point_m) const;
  // The same of the points of some pairs, into as many answers: one does not wait for another.
  void look(std::span<const CandidatePair> pairs, std::span<CameraSet> close) const;

  // The cameras, side by side: one number of each.
  using PerCamera = std::array<float, kMaxCameras>;
  struct Cameras {
    std::array<PerCamera, 3> centre;  // of the model C A H V O R
    std::array<PerCamera, 3> a;
    std::array<PerCamera, 3> h;
    std::array<PerCamera, 3> v;
    std::array<PerCamera, 3> o;
    std::array<PerCamera, 3> r;
    PerCamera oa;  // o . a
    PerCamera oh;
    PerCamera ov;
    PerCamera cells_per_px;
    PerCamera columns;  // of its map
    PerCamera rows;
    std::array<std::int32_t, kMaxCameras> words_per_row;
    std::array<std::int32_t, kMaxCameras> first_word;
  };

 private:
  // Maps reach this far beyond the image on every side.
  static constexpr double kMargin_px = 8.0;
  static constexpr int kMostCells = 544;  // a row, or rows
  static constexpr int kMapWords = kMostCells * (kMostCells / 32 + 1) + 1;

  bool set_camera(std::size_t camera, const core::Camera& seen);
  void draw(std::size_t camera, const estimation::Sightings& sightings);

  alignas(64) Cameras cameras_{};
  std::array<std::uint32_t, kMaxCameras * kMapWords + 1> maps_{};
  CameraSet complex_;  // cameras without a simple model that see something
};

}  // namespace dottrack::acquisition
