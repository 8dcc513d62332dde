#pragma once
// A dot's centre at the limit that noise sets, how uncertain it is, and whether it can be trusted.

#include <Eigen/Core>

#include "app/core/dot_flaw.h"
#include "app/core/image/region.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

using core::DotFlaw;

// What a dot should show as, from elsewhere.
struct ExpectedOutline {
  double semi_major_px = 0.0;
  double semi_minor_px = 0.0;
  double angle_rad = 0.0;  // of the major axis from +x towards +y
};

// A slope of the light on a dot moves its fitted centre. One picture hardly tells the two apart;
// but the slope is the same for all cameras.
struct DotLight {
  Eigen::Vector2d slope_per_px = Eigen::Vector2d::Zero();  // of the dot's contrast, as a part of it
  Eigen::Matrix2d information_px2 = Eigen::Matrix2d::Zero();      // Fisher's, of that slope
  Eigen::Matrix2d centre_by_slope_px2 = Eigen::Matrix2d::Zero();  // what moves the centre
  // The dot was called hidden or merged, and a slope of light would do as well: then the centre has
  // this covariance once the slope is known.
  bool explains = false;
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
};

struct DotFit {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();  // of the outline ellipse
  // From the noise seen at the dot's edge; wider where there is a flaw.
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
  // Of the outline itself: blur is taken out. The angle as a region's.
  double semi_major_px = 0.0;
  double semi_minor_px = 0.0;
  double angle_rad = 0.0;
  double background_dn = 0.0;  // under the centre
  double contrast_dn = 0.0;    // negative: darker than the background
  double noise_dn = 0.0;       // standard deviation of a pixel at the edge
  // What the model leaves of a pixel, root mean square, in units of the noise expected there.
  double misfit = 0.0;
  DotLight light;
  DotFlaw flaw = DotFlaw::not_fitted;  // none: the centre may be trusted to its covariance
};

// Least squares of a blurred ellipse on a sloping background (centre, shape, blur, contrast, level
// and slope together) over the dot and a ring around it, by two scoring steps from the
// centroid of the light, four where that is not enough. For filled dots of 4 to 20 px the centre is
// at the Cramer-Rao bound
//   sigma ~ (noise / contrast) sqrt(4 sqrt(pi) s / (pi d)),  s^2 = blur^2 + 1/12.
// `region`: what identify found in this image. `expected` may be null; where it is known, an
// outline that differs from it is a flaw. Regions with a semi-major axis above 24 px, or next to no
// light, come back as not_fitted with their own centroid and axes.
DotFit fit_dot(const ImageView& image, const Region& region, const ExpectedOutline* expected);

}  // namespace dottrack::image
