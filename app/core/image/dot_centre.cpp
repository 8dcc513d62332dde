#include "app/core/image/dot_centre.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/core/image/ring_sums.h"

namespace dottrack::image {
namespace {

using Eigen::Vector2d;

constexpr double kGrow_px = 1.25;         // what blur puts outside the region
constexpr double kRingWidth_px = 4.0;     // of the background's ring around that
constexpr double kMaxReach_px = 31.0;     // a larger dot's centre gains nothing
constexpr std::int64_t kMinRing_px = 12;  // pixels that a plane can be trusted with
constexpr double kOutlierSigmas = 2.5;
constexpr double kFar_dn = 1e6;  // no grey value is
static_assert(2 * (kMaxReach_px + 1.0) < kMaxPatchSide_px);

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

// The part of the image that holds the ring.
struct Patch {
  int x_min;
  int y_min;
  int x_max;  // both ends included
  int y_max;

  int columns() const { return x_max - x_min + 1; }
  int rows() const { return y_max - y_min + 1; }
};

Patch patch_around(const ImageView& image, const Vector2d& centre, const GrownEllipse& outer) {
  return {std::max(static_cast<int>(std::floor(centre.x() - outer.reach_x)), 0),
          std::max(static_cast<int>(std::floor(centre.y() - outer.reach_y)), 0),
          std::min(static_cast<int>(std::ceil(centre.x() + outer.reach_x)), image.width_px - 1),
          std::min(static_cast<int>(std::ceil(centre.y() + outer.reach_y)), image.height_px - 1)};
}

// Where every row of the patch enters and leaves the ellipse. No call, no branch: the compiler
// makes it several rows at a time.
void set_spans(const GrownEllipse& ellipse, const Vector2d& centre, int rows, int columns,
               std::array<Span, kMaxPatchSide_px>& spans) {
  constexpr int kBias = 256;  // rounding towards zero is rounding down
  const double per_a = 1.0 / ellipse.a;
  for (int row = 0; row < rows; ++row) {
    const double y = row - centre.y();
    const double inside = ellipse.a - ellipse.determinant * y * y;
    const double half = std::sqrt(std::max(inside, 0.0)) * per_a;
    const double middle = centre.x() - ellipse.b * per_a * y;
    const int enters = kBias - static_cast<int>(kBias - (middle - half));
    const int leaves = static_cast<int>(middle + half + kBias) - kBias;
    const int first = std::min(std::max(enters, 0), columns);
    const int last = std::min(leaves, columns - 1);
    const int end = inside >= 0.0 ? std::max(last, first - 1) : first - 1;
    spans[static_cast<std::size_t>(row)] = {static_cast<std::int16_t>(first),
                                            static_cast<std::int16_t>(end)};
  }
}

// A patch whose every row can be read for kPatchColumns_px: in the image, or copied out of it where
// that ends too early.
class Pixels {
 public:
  Pixels(const ImageView& image, const Patch& patch) {
    view_ = {image.row(patch.y_min) + patch.x_min, patch.columns(), patch.rows(),
             image.stride_bytes};
    if (patch.x_min + kPatchColumns_px <= image.width_px) return;
    for (int y = 0; y < patch.rows(); ++y) {
      std::memcpy(copy_ + y * kPatchColumns_px, view_.row(y),
                  static_cast<std::size_t>(patch.columns()));
    }
    view_.data = copy_;
    view_.stride_bytes = kPatchColumns_px;
  }
  Pixels(const Pixels&) = delete;
  Pixels& operator=(const Pixels&) = delete;

  const ImageView& view() const { return view_; }

 private:
  ImageView view_;
  // What lies between the rows' ends counts for nothing, so it is not cleared.
  std::uint8_t copy_[static_cast<std::size_t>(kMaxPatchSide_px) * kPatchColumns_px];
};

struct Plane {
  double at_origin = 0.0;
  double per_x = 0.0;
  double per_y = 0.0;
  double sigma = 0.0;  // of the values about it
};

// Least squares. False when the pixels are too few or lie on a line.
bool fit(const GreySums& sums, Plane& plane) {
  if (sums.n < kMinRing_px) return false;
  const auto times_n = [&](std::int64_t ab, std::int64_t a, std::int64_t b) {
    return static_cast<double>(sums.n * ab - a * b);
  };
  const double xx = times_n(sums.xx, sums.x, sums.x);
  const double xy = times_n(sums.xy, sums.x, sums.y);
  const double yy = times_n(sums.yy, sums.y, sums.y);
  const double vx = times_n(sums.vx, sums.v, sums.x);
  const double vy = times_n(sums.vy, sums.v, sums.y);
  const double vv = times_n(sums.vv, sums.v, sums.v);
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0.0)) return false;
  const auto n = static_cast<double>(sums.n);
  plane.per_x = (yy * vx - xy * vy) / determinant;
  plane.per_y = (xx * vy - xy * vx) / determinant;
  plane.at_origin = (static_cast<double>(sums.v) - plane.per_x * static_cast<double>(sums.x) -
                     plane.per_y * static_cast<double>(sums.y)) /
                    n;
  plane.sigma = std::sqrt(std::max(vv - plane.per_x * vx - plane.per_y * vy, 0.0)) / n;
  return true;
}

IntegerPlane rounded(const Plane& plane, double limit_dn) {
  const auto units = [](double dn) {
    return static_cast<std::int64_t>(std::clamp(dn, -kFar_dn, kFar_dn) / kPlaneUnit_dn);
  };
  return {units(plane.at_origin), units(plane.per_x), units(plane.per_y), units(limit_dn)};
}

bool fit_background(const ImageView& patch, const PatchRows& rows, GreySums& ring, Plane& plane) {
  if (!fit(ring, plane)) return false;
  drop_outliers(patch, rows, rounded(plane, kOutlierSigmas * plane.sigma + 1.0), ring);
  return fit(ring, plane);
}

// Of the light above the plane, in the patch's coordinates; false when there is next to none.
bool centroid(const GreySums& dot, const Plane& plane, Vector2d& centre) {
  const auto above = [&](std::int64_t v, std::int64_t one, std::int64_t x, std::int64_t y) {
    return static_cast<double>(v) - plane.at_origin * static_cast<double>(one) -
           plane.per_x * static_cast<double>(x) - plane.per_y * static_cast<double>(y);
  };
  const double light = above(dot.v, dot.n, dot.x, dot.y);
  // At least a grey level on average; dark dots give less than no light.
  if (!(std::abs(light) >= static_cast<double>(dot.n)) || dot.n == 0) return false;
  centre =
      Vector2d(above(dot.vx, dot.x, dot.xx, dot.xy), above(dot.vy, dot.y, dot.xy, dot.yy)) / light;
  return true;
}

}  // namespace

Eigen::Vector2d dot_centre(const ImageView& image, const Region& region) {
  if (!(region.semi_major_px + kGrow_px + kRingWidth_px <= kMaxReach_px)) return region.centroid_px;
  const double cosine = std::cos(region.angle_rad);
  const double sine = std::sin(region.angle_rad);
  const GrownEllipse inner(region, cosine, sine, kGrow_px);
  const GrownEllipse outer(region, cosine, sine, kGrow_px + kRingWidth_px);
  const Patch patch = patch_around(image, region.centroid_px, outer);
  if (patch.columns() <= 0 || patch.rows() <= 0) return region.centroid_px;
  const Vector2d corner(patch.x_min, patch.y_min);
  const Vector2d middle = region.centroid_px - corner;
  PatchRows rows;
  rows.count = patch.rows();
  set_spans(outer, middle, patch.rows(), patch.columns(), rows.outer);
  set_spans(inner, middle, patch.rows(), patch.columns(), rows.inner);
  const Pixels pixels(image, patch);
  PatchSums sums = sum_patch(pixels.view(), rows);
  Plane background;
  Vector2d centre;
  if (!fit_background(pixels.view(), rows, sums.ring, background) ||
      !centroid(sums.dot, background, centre) ||
      (centre - middle).norm() > 0.5 * region.semi_minor_px) {
    return region.centroid_px;
  }
  return corner + centre;
}

}  // namespace dottrack::image
