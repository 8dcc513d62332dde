#pragma once
// What a dot's pixels say about its centre and the background's slope: Fisher's information at unit
// noise, from integrals along the outline instead of sums over pixels, and what they say of a slope
// of the dot's own light, from such sums. Of a symmetric dot none of these has to do with shape,
// blur, contrast and level.

#include <Eigen/Core>

#include "app/core/image/outline_sums.h"

namespace dottrack::image {

// The pixels that a model is fitted to, those of the dot and of its ring.
struct FitWindow {
  double count = 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();     // place, in the patch's coordinates
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();  // sum of (place - mean)(place - mean)^T
};

// Derivatives of half the sum of squares, or a step. The slope turns about the window's mean.
struct CentreVector {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
};

// A slope of the dot's own light, in grey levels a pixel: what the residuals say of it.
struct LightSlope {
  Eigen::Vector2d slope_dn = Eigen::Vector2d::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();      // Fisher's, at unit noise
  Eigen::Matrix2d centre_by_slope = Eigen::Matrix2d::Zero();  // how far it moves the fitted centre
  double gain_dn2 = 0.0;  // what it takes off the sum of squares
};

class CentreInformation {
 public:
  CentreInformation(const OutlineModel& model, const FitWindow& window);

  double area_px2() const { return area_; }
  double length_px() const { return length_; }
  // Lower; shape^-1 = root root^T.
  const Eigen::Matrix2d& root() const { return root_; }
  static Eigen::Vector2d centre_gradient(const OutlineModel& model, const ResidualSums& sums);
  // The Fisher scoring step.
  CentreVector step(const CentreVector& gradient) const;
  // Of the centre at unit noise.
  const Eigen::Matrix2d& covariance() const { return covariance_; }
  // How much the residuals' asymmetry shows of an outline with third harmonics and of a dot with a
  // slope of light of its own: chi-square of 4 degrees of freedom at unit noise, after the step.
  // `derivatives` are of a model close to this one.
  double asymmetry(const OutlineModel& model, const ResidualSums& sums,
                   const DerivativeSums& derivatives, const CentreVector& step) const;
  // The same of that slope alone.
  LightSlope light_slope(const OutlineModel& model, const ResidualSums& sums,
                         const DerivativeSums& derivatives, const CentreVector& step) const;

 private:
  void integrate(const OutlineModel& model);
  Eigen::Matrix2d light_by_slope(const OutlineModel& model) const;
  double curved(double blur2_px2) const;

  Eigen::Matrix2d root_;
  double area_ = 0.0;
  double length_ = 0.0;
  Eigen::Matrix2d normal_normal_;  // n n^T along the outline, by length
  double centre_slope_ = 0.0;      // times the identity, by Gauss's theorem
  Eigen::Matrix2d per_scatter_;
  Eigen::Matrix2d covariance_;
};

}  // namespace dottrack::image
