#pragma once
// Exact sums over a dot's pixels and over the ring around it: what a plane and a centroid need.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/image/patch_rows.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// Of 1, x, y and their products over some pixels, in the patch's coordinates, and of their grey
// values v.
struct GreySums : PlaceSums {
  std::int64_t v = 0;
  std::int64_t vx = 0;
  std::int64_t vy = 0;
  std::int64_t vv = 0;  // of the ring only
};

struct PatchSums {
  GreySums dot;
  GreySums ring;
};

// Which pixels of a patch are the ring's, all bits of a lane or none, in strips of columns: what
// the sums work out on their way.
struct RingMask {
  std::array<std::int16_t, kPatchRows_px * kPatchColumns_px> of;
};

// Integer arithmetic: the same on every processor. `patch` has width_px columns and is
// readable for kPatchColumns_px.
PatchSums sum_patch(const ImageView& patch, const PatchRows& rows, RingMask& mask);

// A plane of grey values and how far a pixel may be off it, all in units of kPlaneUnit_dn. In 32
// bits there is room for kFar_dn at the origin and kSteep_dn a pixel.
inline constexpr double kPlaneUnit_dn = 1.0 / 65536.0;
inline constexpr double kFar_dn = 8000.0;
inline constexpr double kSteep_dn = 60.0;
struct IntegerPlane {
  std::int32_t at_origin = 0;
  std::int32_t per_x = 0;
  std::int32_t per_y = 0;
  std::int32_t limit = 0;
};

// Takes the ring's pixels that are off the plane by more than the limit out of its sums. Off by how
// much is known to a part in 64 of a grey level.
void drop_outliers(const ImageView& patch, const RingMask& mask, const IntegerPlane& plane,
                   GreySums& ring);

// Pixels of a patch, a bit a column, row by row. The widest patch has one more column: that is in
// no map.
inline constexpr int kMapColumns = 64;
using PixelMap = std::array<std::uint64_t, kPatchRows_px>;

// Those of a patch that are off the plane by more than the limit, likewise.
void find_off_plane(const ImageView& patch, const IntegerPlane& plane, PixelMap& map);

// Takes a map's pixels out of sums.
void subtract(const ImageView& patch, const PixelMap& map, GreySums& sums);

}  // namespace dottrack::image
