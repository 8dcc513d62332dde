#pragma once
// Many pixels of one camera at a time: unproject, and project's derivatives along the ray.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/geometry/camera_model.h"

namespace dottrack::geometry {

// Side by side, as many as are given of each.
struct PixelBundle {
  static constexpr std::size_t kCapacity = 64;
  using Numbers = std::array<double, kCapacity>;
  using Axes = std::array<Numbers, 3>;

  std::size_t size = 0;
  alignas(64) Numbers x{};  // the pixels; beyond size anything finite
  alignas(64) Numbers y{};

  // Where 0, the rest is not known: `unproject` is to be asked.
  std::array<std::uint8_t, kCapacity> known{};
  alignas(64) Axes direction{};  // of the ray, from the model's centre
  // d(x) and d(y) / d(point), times the point's range: the same all along the ray.
  alignas(64) Axes x_per_rad{};
  alignas(64) Axes y_per_rad{};

  Ray ray(std::size_t i, const CameraModel& model) const {
    return {centre(model), {direction[0][i], direction[1][i], direction[2][i]}};
  }
  ProjectionJacobian pixels_per_rad(std::size_t i) const {
    ProjectionJacobian jacobian;
    for (int axis = 0; axis < 3; ++axis) {
      jacobian(0, axis) = x_per_rad[static_cast<std::size_t>(axis)][i];
      jacobian(1, axis) = y_per_rad[static_cast<std::size_t>(axis)][i];
    }
    return jacobian;
  }
};

// As unproject and project to rounding, where a pixel is clearly within the lens's domain. Of the
// CAHVORE model, whose rays have origins of their own, nothing is known. The same bits on every
// processor.
void unproject_bundle(const CameraModel& model, PixelBundle& bundle) noexcept;

}  // namespace dottrack::geometry
