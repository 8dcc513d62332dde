#pragma once
// A dot's centre from its rim.

#include <Eigen/Core>
#include <optional>

#include "hal/base/image_view.h"

namespace dottrack::calibrate {

struct Disc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // pixels
  double semi_major_px = 0.0;
  double semi_minor_px = 0.0;
  double angle_rad = 0.0;    // of the major axis from +x towards +y
  double contrast_dn = 0.0;  // above the surround; below 0: darker than it
  double sigma_px = 0.0;     // of each coordinate of the centre, from what the fit leaves over
};

// The ellipse, evenly bright within a narrow edge, on a plane of grey values, that explains the
// pixels around best; pixels that are far off, a glint, a scratch beside it, count little. On a
// real plate, whose dots are lit from one side, centres of light are pulled towards the light by up
// to half a pixel; their rims are not. Nothing: next to the image's border, or the fit wanders off
// from the start.
std::optional<Disc> fit_disc(const ImageView& image, const Disc& start);

}  // namespace dottrack::calibrate
