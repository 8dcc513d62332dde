#pragma once
// A 4-neighbour-connected set of in-band pixels: what identify finds (paper sections 3.1.2, 3.3).

#include <Eigen/Core>
#include <cstdint>

namespace dottrack::image {

struct Region {
  // Centroid, pixels. A pixel weighs one more than it exceeds what it needed to be in band: the
  // local background at its place and the contrast to it, and the near end of the absolute band
  // (bright: intensity_min_dn), whichever asks for more. So a pixel at the threshold weighs little
  // and a flat region's centroid is that of its area; a slope of light does not move it.
  Eigen::Vector2d centroid_px = Eigen::Vector2d::Zero();
  // Semi-axes of the uniform ellipse with the same second moments, pixels, and the angle of the
  // major axis from +x towards +y, radians in (-pi/2, pi/2].
  double semi_major_px = 0.0;
  double semi_minor_px = 0.0;
  double angle_rad = 0.0;
  int area_px = 0;
  // How far the bounding box of that ellipse, about the area's centroid, is from the region's own,
  // at the worst of the four sides. A filled ellipse has none, but for its ragged rim; a half moon,
  // an L, a ring, a bar with a bulge or two dots grown together have much.
  double box_misfit_px = 0.0;
  // Mean of the 3 x 3 pixels around the centroid over the region's faintest pixel, towards the
  // dots' polarity: negative where the region is a scatter of noise without a core.
  double core_contrast_dn = 0.0;
  int saturated_px = 0;  // pixels at 255
  // Bounding box, both ends included.
  std::int16_t x_min = 0;
  std::int16_t x_max = 0;
  std::int16_t y_min = 0;
  std::int16_t y_max = 0;
  bool touches_border = false;  // of the image or of the window that was searched

  int width_px() const { return x_max - x_min + 1; }
  int height_px() const { return y_max - y_min + 1; }
};

}  // namespace dottrack::image
