#include "app/core/geometry/optics.h"

#include <algorithm>
#include <cmath>

namespace dottrack::geometry {
namespace {

// Singular values of d(direction)/d(pixel) are radians a pixel; the scale is their inverse.
AngularScale scale_at(const CameraModel& model, const Eigen::Vector2d& pixel) {
  Ray ray;
  RayJacobian jacobian;
  if (unproject(model, pixel, ray, &jacobian) != OpticsStatus::ok) return {};
  const Eigen::Matrix2d gram = jacobian.direction.transpose() * jacobian.direction;
  const double middle = 0.5 * gram.trace();
  const double swing = std::hypot(0.5 * (gram(0, 0) - gram(1, 1)), gram(0, 1));
  if (!(middle - swing > 0.0)) return {};
  return {1.0 / std::sqrt(middle + swing), 1.0 / std::sqrt(middle - swing)};
}

}  // namespace

Optics::Optics(const CameraModel& model, int width_px, int height_px)
    : cells_per_column_(static_cast<double>(kCells) / width_px),
      cells_per_row_(static_cast<double>(kCells) / height_px) {
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      const double x = (column + 0.5) / cells_per_column_ - 0.5;
      const double y = (row + 0.5) / cells_per_row_ - 0.5;
      const AngularScale scale = scale_at(model, {x, y});
      cells_[cell(column, row)] = scale;
      if (scale.max_px <= 0.0) continue;
      extremes_.min_px =
          extremes_.min_px > 0.0 ? std::min(extremes_.min_px, scale.min_px) : scale.min_px;
      extremes_.max_px = std::max(extremes_.max_px, scale.max_px);
    }
  }
}

}  // namespace dottrack::geometry
