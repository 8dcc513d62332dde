#pragma once
// What a fit says about its dot: how uncertain the centre is and what is wrong.

#include <Eigen/Core>

#include "app/core/image/centre_information.h"
#include "app/core/image/dot_fit.h"
#include "app/core/image/outline_sums.h"

namespace dottrack::image {

// What a fitted model leaves unexplained.
struct LeftOver {
  int pixels = 0;                                           // of the dot and its blurred edge
  double area_px2 = 0.0;                                    // of the outline
  double length_px = 0.0;                                   // of the outline
  Eigen::Matrix2d per_shape = Eigen::Matrix2d::Identity();  // A^-1: half widths, squared
  double ring_noise_dn2 = 0.0;                              // variance of the background
  double chi2_dn2 = 0.0;                                    // sum of squares
  double covered_chi2_dn2 = 0.0;                            // the part that lies within the outline
  double edge_chi2_dn2 = 0.0;  // weighed with the normal density at the distance to it
  double asymmetry_dn2 = 0.0;  // CentreInformation::asymmetry
  LightSlope light;
  Eigen::Matrix2d centre_covariance = Eigen::Matrix2d::Zero();  // at unit noise
  Eigen::Matrix3d shape_covariance = Eigen::Matrix3d::Zero();   // of A, at unit noise
};

// All but the flaw.
void describe(const Eigen::Vector2d& centre_px, const OutlineModel& model, const LeftOver& left,
              DotFit& fit);

// The flaw; widens the covariance where there is one.
void judge(const ImageView& image, const Region& region, const LeftOver& left,
           const ExpectedOutline* expected, DotFit& fit);

}  // namespace dottrack::image
