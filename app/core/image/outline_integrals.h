#pragma once
// Integrals along the outline of a blurred ellipse: what sums over its pixels come to, however many
// those are.

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "app/core/image/outline_sums.h"

namespace dottrack::image {

// An ellipse u^T A u = 1 as the unit circle's image: A^-1 = root root^T, root lower triangular.
struct Outline {
  explicit Outline(const Eigen::Matrix2d& shape);

  Eigen::Matrix2d per_shape;  // A^-1
  Eigen::Matrix2d root;
  double determinant;  // of root: the area is pi times that
};

// Along the outline, by angle of the circle. n: unit normal; h = 1 / |A u|; t = blur / h.
struct OutlineIntegrals {
  // clang-format off
  enum Term : std::size_t {
    kLength, kNxx, kNxy, kNyy,      // by length: 1, n n^T
    kT, kTt,                        // t, t^2
    kXx, kXy, kYy,                  // 1 + t^2 - k, k = blur^2 (trace A - 1 / h^2), with u u^T
    kTxx, kTxy, kTyy,               // t with u u^T
    // What the blur does (ShapeInformation): to itself, to the contrast, and with u u^T.
    kBb, kBe, kBxx, kBxy, kByy,
    kXxxx, kXxxy, kXxyy, kXyyy, kYyyy,  // h (1 + 3/2 t^2 - 2 k + k^2), with four of u
    kTerms
  };
  // clang-format on
  std::array<double, kTerms> of{};

  double operator[](Term term) const { return of[term]; }
};

OutlineIntegrals integrate(const OutlineModel& model, const Outline& outline);

// With the third harmonics of u, (x^3 - 3 x y^2, 3 x^2 y - y^3).
struct ThirdIntegrals {
  Eigen::Matrix2d place_place;   // by length: u u^T
  Eigen::Matrix2d third_third;   // by length, h^2: third third^T
  Eigen::Matrix2d third_normal;  // by length, h: third n^T
  Eigen::Matrix2d third_place;   // by length, h: third u^T
};

ThirdIntegrals integrate_thirds(const Outline& outline);

}  // namespace dottrack::image
