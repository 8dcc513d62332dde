#pragma once
// Which pixels of a patch, row by row, lie in an ellipse.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "app/core/image/region.h"

namespace dottrack::image {

inline constexpr int kMaxPatchSide_px = 65;
inline constexpr int kPatchColumns_px = 80;       // that a patch's every row can be read for
inline constexpr std::size_t kPatchRows_px = 72;  // worked on some at a time

// The region's ellipse grown by some pixels: a x^2 + 2 b x y + c y^2 <= 1 about its centre.
struct GrownEllipse {
  GrownEllipse(const Region& region, double cosine, double sine, double grow_px) {
    const double major = region.semi_major_px + grow_px;
    const double minor = region.semi_minor_px + grow_px;
    const double m = 1.0 / (major * major);
    const double n = 1.0 / (minor * minor);
    a = cosine * cosine * m + sine * sine * n;
    b = cosine * sine * (m - n);
    determinant = m * n;
    reach_x = std::sqrt(cosine * cosine * major * major + sine * sine * minor * minor);
    reach_y = std::sqrt(sine * sine * major * major + cosine * cosine * minor * minor);
  }

  double a;
  double b;
  double determinant;  // a c - b^2
  double reach_x;      // of its bounding box
  double reach_y;
};

// Sums over pixels of 1, of their coordinates and of the products of these.
struct PlaceSums {
  std::int64_t n = 0;
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t xx = 0;
  std::int64_t xy = 0;
  std::int64_t yy = 0;
};

// The columns x of every row with before < x < after; none: after = before + 1.
struct Spans {
  std::array<std::int16_t, kPatchRows_px> before;
  std::array<std::int16_t, kPatchRows_px> after;
  PlaceSums places;

  bool holds(int x, int y) const {
    const auto row = static_cast<std::size_t>(y);
    return before[row] < x && x < after[row];
  }
};

// A dot and its ring, row by row: the ring is `outer` without `inner`, the dot is `inner`.
struct PatchRows {
  int count = 0;
  Spans outer;
  Spans inner;
};

// Of a patch's first `rows` rows of `columns` columns. The same on every processor.
void set_spans(const GrownEllipse& ellipse, const Eigen::Vector2d& centre, int rows, int columns,
               Spans& spans);

}  // namespace dottrack::image
