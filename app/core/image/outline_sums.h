#pragma once
// What a blurred ellipse on a sloping background leaves of a dot's pixels, summed up against the
// ways in which that model can give.

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "app/core/image/dot_pixels.h"

namespace dottrack::image {

// Of an ellipse u^T A u = 1 about its centre, blurred by a Gaussian, in a patch's coordinates:
//   grey = background + slope . u + contrast Phi(distance inside the outline / blur).
// `blur` is the lens's and the pixel's own together: blur^2 = psf^2 + 1/12.
struct OutlineModel {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Matrix2d shape = Eigen::Matrix2d::Identity();  // A, 1/px^2
  double blur_px = 0.0;
  double contrast_dn = 0.0;
  double background_dn = 0.0;  // at the centre
  Eigen::Vector2d slope_dn = Eigen::Vector2d::Zero();
};

// A^-1 of an ellipse.
inline Eigen::Matrix2d ellipse_matrix(double major_px, double minor_px, double cosine,
                                      double sine) {
  const double major2 = major_px * major_px;
  const double minor2 = minor_px * minor_px;
  const double xy = cosine * sine * (major2 - minor2);
  Eigen::Matrix2d matrix;
  matrix << cosine * cosine * major2 + sine * sine * minor2, xy, xy,
      sine * sine * major2 + cosine * cosine * minor2;
  return matrix;
}

// Sums over the pixels of the residual r = grey - model. u: place from the centre; e: how much of
// a pixel the dot covers; p: the standard normal density at z, the distance from the outline in
// blurs; w: p over the length of A u, which is how far the outline moves when u^T A u does.
struct ResidualSums {
  // clang-format off
  enum Term : std::size_t {
    kR, kRx, kRy, kRe, kRwx, kRwy, kRwxx, kRwxy, kRwyy, kRpz,
    kCommon,
    // How the model may fail: the outline's third harmonics and a slope of the dot's own light.
    kRw3c = kCommon, kRw3s, kRex, kRey, kRr, kRre, kRrp,
    kTerms
  };
  // clang-format on
  std::array<double, kTerms> of{};

  double operator[](Term term) const { return of[term]; }
};

// Sums of products of the model's derivatives, as above without r; wxxyy is w^2 x^2 y^2 and so on.
struct DerivativeSums {
  // clang-format off
  enum Term : std::size_t {
    kWxxxx, kWxxxy, kWxxyy, kWxyyy, kWyyyy,
    kWxx, kWxy, kWyy, kEwxx, kEwxy, kEwyy, kPzwxx, kPzwxy, kPzwyy,
    kPzpz, kPze, kPz, kEe, kE,
    kWwxx, kWwxy, kWwyy, kEexx, kEexy, kEeyy,
    kTerms
  };
  // clang-format on
  std::array<double, kTerms> of{};

  double operator[](Term term) const { return of[term]; }
};

// Single precision in lanes; the same on every processor. The first leaves out what follows
// kCommon.
void sum_derivatives(const DotPixels& pixels, const OutlineModel& model, ResidualSums& residuals,
                     DerivativeSums& derivatives);
void sum_residuals(const DotPixels& pixels, const OutlineModel& model, ResidualSums& residuals);

}  // namespace dottrack::image
