#pragma once
// How many pixels a radian spans, anywhere in one camera's image: what sizes are judged by.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "app/core/geometry/camera_model.h"

namespace dottrack::geometry {

// Pixels a radian across and along the direction in which the image is stretched most.
struct AngularScale {
  double min_px = 0.0;
  double max_px = 0.0;

  double mean_px() const { return std::sqrt(min_px * max_px); }  // geometric mean
};

// A table over the image, made once at start-up from the model's partial derivatives
// (paper section 3.4). A lookup costs a few operations.
class Optics {
 public:
  Optics() = default;
  Optics(const CameraModel& model, int width_px, int height_px);

  // Of the grid cell that holds the pixel; pixels outside the image take the nearest cell.
  // Zero where the lens sees nothing.
  const AngularScale& at(const Eigen::Vector2d& pixel) const {
    const auto nearest = [](double at) {
      return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(kCells - 1)));
    };
    return cells_[cell(nearest((pixel.x() + 0.5) * cells_per_column_),
                       nearest((pixel.y() + 0.5) * cells_per_row_))];
  }
  // Smallest and largest over the whole image; zero for a camera that sees nothing.
  const AngularScale& extremes() const { return extremes_; }

 private:
  static constexpr int kCells = 32;

  static constexpr std::size_t cell(int column, int row) {
    return static_cast<std::size_t>(row) * kCells + static_cast<std::size_t>(column);
  }

  std::array<AngularScale, static_cast<std::size_t>(kCells* kCells)> cells_{};
  AngularScale extremes_;
  double cells_per_column_ = 0.0;
  double cells_per_row_ = 0.0;
};

}  // namespace dottrack::geometry
