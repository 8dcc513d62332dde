#pragma once
// A pinhole camera from labelled points without a start: the direct linear transformation on
// normalised coordinates, then least squares over ten numbers (place, attitude, scales, centre).

#include <Eigen/Core>
#include <optional>
#include <span>

#include "app/core/geometry/cahv.h"

namespace dottrack::calibrate {

struct ImageExtent {
  int width_px = 0;
  int height_px = 0;
};

// Points in metres (world) and where the camera shows them, in the same order; no outliers among
// them. Square pixels and a centre near the image's middle are weakly preferred where the extent is
// known. Points in one plane, of which four are enough, need the extent; the others need six. A
// model is right-handed unless the points are mirrored: see mirrored(). Points are in front of it.
// Nothing where the points are too few or do not determine a camera: on a line, or in a plane that
// is seen straight on, so that distance and focal length cannot be told apart.
std::optional<geometry::Cahv> fit_cahv(std::span<const Eigen::Vector3d> points,
                                       std::span<const Eigen::Vector2d> pixels,
                                       ImageExtent extent = {});

// Whether a model shows the world as in a mirror: columns to the right and rows down do not make a
// right-handed frame with the direction of view.
bool mirrored(const geometry::Cahv& model);

// Root mean square distance of the points' images from the pixels; infinite if one is behind.
double rms_px(const geometry::Cahv& model, std::span<const Eigen::Vector3d> points,
              std::span<const Eigen::Vector2d> pixels);

}  // namespace dottrack::calibrate
