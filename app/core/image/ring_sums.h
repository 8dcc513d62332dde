#pragma once
// Exact sums over a dot's pixels and over the ring around it: what a plane and a centroid need.

#include <array>
#include <cstdint>

#include "hal/base/image_view.h"

namespace dottrack::image {

inline constexpr int kMaxPatchSide_px = 65;
inline constexpr int kPatchColumns_px = 80;  // that a patch's every row can be read for

// Columns of a patch's row, both ends included; none: last = first - 1.
struct Span {
  std::int16_t first = 0;
  std::int16_t last = -1;
};

// A dot and its ring, row by row: the ring is `outer` without `inner`, the dot is `inner`.
struct PatchRows {
  int count = 0;
  std::array<Span, kMaxPatchSide_px> outer;
  std::array<Span, kMaxPatchSide_px> inner;
};

// Of 1, x, y and their products over some pixels, in the patch's coordinates; v: grey values.
struct GreySums {
  std::int64_t n = 0;
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t xx = 0;
  std::int64_t xy = 0;
  std::int64_t yy = 0;
  std::int64_t v = 0;
  std::int64_t vx = 0;
  std::int64_t vy = 0;
  std::int64_t vv = 0;  // of the ring only
};

// Takes a pixel out.
inline void subtract(GreySums& sums, int x, int y, int v) {
  sums.n -= 1;
  sums.x -= x;
  sums.y -= y;
  sums.xx -= x * x;
  sums.xy -= x * y;
  sums.yy -= y * y;
  sums.v -= v;
  sums.vx -= v * x;
  sums.vy -= v * y;
  sums.vv -= v * v;
}

struct PatchSums {
  GreySums dot;
  GreySums ring;
};

// Integer arithmetic: the same on every processor. `patch` has width_px columns and is
// readable for kPatchColumns_px.
PatchSums sum_patch(const ImageView& patch, const PatchRows& rows);

// A plane of grey values and how far a pixel may be off it, all in units of kPlaneUnit_dn.
inline constexpr double kPlaneUnit_dn = 1.0 / 65536.0;
struct IntegerPlane {
  std::int64_t at_origin = 0;
  std::int64_t per_x = 0;
  std::int64_t per_y = 0;
  std::int64_t limit = 0;
};

// Takes the ring's pixels that are off the plane by more than the limit out of its sums. Off by how
// much is known to a part in 64 of a grey level.
void drop_outliers(const ImageView& patch, const PatchRows& rows, const IntegerPlane& plane,
                   GreySums& ring);

}  // namespace dottrack::image
