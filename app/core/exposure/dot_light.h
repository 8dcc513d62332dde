#pragma once
// How bright one dot is in one image, and the image as a whole.

#include <Eigen/Core>

#include "hal/base/image_view.h"

namespace dottrack::exposure {

// Where a dot is: its ellipse in the image.
struct DotSpot {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double semi_major_px = 0.0;
  double semi_minor_px = 0.0;
  double angle_rad = 0.0;  // of the major axis from +x towards +y
};

struct DotLight {
  int inside_px = 0;            // pixels of the dot that lie in the image
  int peak_dn = 0;              // that nine tenths of them do not exceed
  int saturated_px = 0;         // of them, at full scale
  int saturated_around_px = 0;  // outside of its blurred rim, within some pixels
  int surround_dn = 0;          // median of what is around it
  int noise_dn = 0;             // half of what the middle two thirds of that spread over
};

// Dots beyond 40 pixels of reach are measured in their middle.
DotLight measure_dot(const ImageView& image, const DotSpot& spot);

// Of every 8th pixel of every 8th row.
struct ImageLight {
  double mean_dn = 0.0;
  int high_dn = 0;               // that 99 of 100 pixels do not exceed
  double saturated_share = 0.0;  // at full scale
};

ImageLight measure_image(const ImageView& image);

}  // namespace dottrack::exposure
