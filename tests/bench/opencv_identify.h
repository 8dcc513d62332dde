#pragma once
// What OpenCV offers for identify's work: the band, then regions with area, box and moments. On one
// thread, as identify is: it is processor time that is compared.

#include <cstddef>
#include <vector>

#include "hal/base/image_view.h"

namespace dottrack::bench {

// Of all that this process does with OpenCV.
void use_one_opencv_thread();

// inRange, findContours (external outlines), moments of each outline. Returns how many outlines.
// They are of 8-connected components, since OpenCV outlines no others.
std::size_t opencv_contours(const ImageView& image);

// inRange, connectedComponentsWithStats (4-connected). Returns how many components.
std::size_t opencv_connected_components(const ImageView& image);

// A 4-connected component of two pixels or more. All pixels weigh the same.
struct Blob {
  int area_px = 0;
  int x_min = 0;
  int y_min = 0;
  int width_px = 0;
  int height_px = 0;
  double x = 0.0;  // centroid
  double y = 0.0;
  double semi_major_px = 0.0;  // of the ellipse with the same moments
  double semi_minor_px = 0.0;
};

// By connectedComponentsWithStats, and moments of each component.
std::vector<Blob> opencv_blobs(const ImageView& image);

}  // namespace dottrack::bench
