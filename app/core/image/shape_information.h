#pragma once
// What a dot's pixels say about its outline's shape and blur and the two grey levels: the normal
// equations of a Gauss-Newton step, from sums over the pixels.

#include <Eigen/Core>

#include "app/core/image/outline_sums.h"

namespace dottrack::image {

class ShapeInformation {
 public:
  // A's 11, 12 (= 21) and 22, blur, contrast, background.
  static constexpr int kParameters = 6;
  using Vector = Eigen::Matrix<double, kParameters, 1>;
  using Matrix = Eigen::Matrix<double, kParameters, kParameters>;

  // `pixels`: of the dot and its ring. `blur_prior`: information on the blur from elsewhere.
  ShapeInformation(const OutlineModel& model, const DerivativeSums& sums, double pixels,
                   double blur_prior);

  bool ok() const { return ok_; }                           // every parameter is determined
  const Matrix& covariance() const { return covariance_; }  // at unit noise

  // Derivatives of half the sum of squares; that by the background is left to the caller.
  static Vector gradient(const OutlineModel& model, const ResidualSums& sums);

 private:
  bool invert();

  Matrix covariance_;  // the information, until it is inverted: its lower triangle
  bool ok_ = false;
};

}  // namespace dottrack::image
