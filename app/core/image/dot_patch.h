#pragma once
// The part of an image around a dot: its pixels row by row inside ellipses, and a plane of grey
// values fitted to some of them.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "app/core/image/ring_sums.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

inline constexpr double kMaxReach_px = 31.0;  // of an ellipse on a patch
static_assert(2 * (kMaxReach_px + 1.0) < kMaxPatchSide_px);

// The part of the image that holds the ring.
struct Patch {
  int x_min;
  int y_min;
  int x_max;  // both ends included
  int y_max;

  int columns() const { return x_max - x_min + 1; }
  int rows() const { return y_max - y_min + 1; }
};

Patch patch_around(const ImageView& image, const Eigen::Vector2d& centre,
                   const GrownEllipse& outer);

// A patch whose every row can be read for kPatchColumns_px: in the image, or copied out of it where
// that ends too early.
class Pixels {
 public:
  Pixels(const ImageView& image, const Patch& patch);
  Pixels(const Pixels&) = delete;
  Pixels& operator=(const Pixels&) = delete;

  const ImageView& view() const { return view_; }

 private:
  ImageView view_;
  // What lies between the rows' ends counts for nothing, so it is not cleared.
  std::uint8_t copy_[static_cast<std::size_t>(kMaxPatchSide_px) * kPatchColumns_px];
};

// Grey values, at_origin + per_x x + per_y y.
struct Plane {
  double at_origin = 0.0;
  double per_x = 0.0;
  double per_y = 0.0;
  double sigma = 0.0;  // of the values about it
};

// Least squares over the pixels that were summed. False when they are too few or lie on a line.
bool fit(const GreySums& sums, Plane& plane);

IntegerPlane rounded(const Plane& plane, double limit_dn);

}  // namespace dottrack::image
