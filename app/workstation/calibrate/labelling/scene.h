#pragma once
// One camera's share of the labelling: which blob is which surveyed dot?

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "app/workstation/calibrate/labelling/blob_index.h"
#include "app/workstation/calibrate/labelling/blobs.h"
#include "app/workstation/calibrate/views.h"

namespace dottrack::calibrate {

// Dots that stand for good are sought in the mean of all pictures, layer 0; those of a target that
// is carried about, in the picture of their tick, a layer of its own.
struct Scene {
  std::span<const SurveyedDot> dots;
  std::vector<int> dot_layer;  // of each dot; -1: no picture shows it
  int width_px = 0;
  int height_px = 0;
  std::vector<Blob> blobs;
  BlobIndex index;

  bool holds(const Eigen::Vector2d& pixel) const {
    return pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < width_px - 0.5 &&
           pixel.y() < height_px - 0.5;
  }
};

inline constexpr int kNoBlob = -1;

// For each dot of the survey the blob that it is, or kNoBlob. No blob is two dots.
using Labels = std::vector<int>;

inline std::size_t count(const Labels& labels) {
  std::size_t labelled = 0;
  for (const int blob : labels) labelled += blob != kNoBlob ? 1U : 0U;
  return labelled;
}

}  // namespace dottrack::calibrate
