#include "app/core/image/dot_centre.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "hal/base/static_vector.h"

namespace dottrack::image {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kGrow_px = 1.25;      // what blur puts outside the region
constexpr double kRingWidth_px = 4.0;  // of the background's ring around that
constexpr int kMaxReach_px = 32;       // a larger dot's centre gains nothing
constexpr std::size_t kMinRing = 12;   // pixels that a plane can be trusted with
constexpr double kOutlierSigmas = 2.5;

struct Pixel {
  float x;  // from the region's centroid
  float y;
  float value;
};

constexpr std::size_t kMaxSide = 2 * kMaxReach_px + 1;
constexpr std::size_t kMaxPixels = kMaxSide * kMaxSide;
using Pixels = StaticVector<Pixel, kMaxPixels>;

// The region's ellipse as a distance: 0 at the centre, the semi-axes' mean at its edge.
class EllipseDistance {
 public:
  explicit EllipseDistance(const Region& region)
      : cosine_(std::cos(region.angle_rad)),
        sine_(std::sin(region.angle_rad)),
        major_(region.semi_major_px),
        minor_(region.semi_minor_px) {}

  // Squared, in units of the ellipse grown by grow_px: at most 1 inside.
  double squared(double x, double y, double grow_px) const {
    const double along = (cosine_ * x + sine_ * y) / (major_ + grow_px);
    const double across = (cosine_ * y - sine_ * x) / (minor_ + grow_px);
    return along * along + across * across;
  }

 private:
  double cosine_;
  double sine_;
  double major_;
  double minor_;
};

// Sorts the pixels around the region into the grown dot and its ring.
void collect(const ImageView& image, const Region& region, Pixels& dot, Pixels& ring) {
  const EllipseDistance distance(region);
  const int reach = static_cast<int>(std::ceil(region.semi_major_px + kGrow_px + kRingWidth_px));
  const int cx = static_cast<int>(std::lround(region.centroid_px.x()));
  const int cy = static_cast<int>(std::lround(region.centroid_px.y()));
  for (int y = std::max(cy - reach, 0); y <= std::min(cy + reach, image.height_px - 1); ++y) {
    for (int x = std::max(cx - reach, 0); x <= std::min(cx + reach, image.width_px - 1); ++x) {
      const double dx = x - region.centroid_px.x();
      const double dy = y - region.centroid_px.y();
      const Pixel pixel{static_cast<float>(dx), static_cast<float>(dy),
                        static_cast<float>(image.at(x, y))};
      if (distance.squared(dx, dy, kGrow_px) <= 1.0) {
        dot.push_back(pixel);
      } else if (distance.squared(dx, dy, kGrow_px + kRingWidth_px) <= 1.0) {
        ring.push_back(pixel);
      }
    }
  }
}

struct Plane {
  Vector3d coefficients = Vector3d::Zero();  // of 1, x, y
  double sigma = 0.0;                        // of the ring's values about it

  double residual(const Pixel& p) const {
    return static_cast<double>(p.value) - coefficients.dot(Vector3d(1.0, p.x, p.y));
  }
};

// Least squares over the ring's pixels that lie within `limit` of `prior`.
bool fit(const Pixels& ring, const Plane& prior, double limit, Plane& plane) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  double sum2 = 0.0;
  std::size_t n = 0;
  for (const Pixel& p : ring) {
    if (std::abs(prior.residual(p)) > limit) continue;
    const Vector3d row(1.0, p.x, p.y);
    normal += row * row.transpose();
    right += p.value * row;
    sum2 += static_cast<double>(p.value) * static_cast<double>(p.value);
    ++n;
  }
  if (n < kMinRing) return false;
  plane.coefficients = normal.ldlt().solve(right);
  plane.sigma =
      std::sqrt(std::max(sum2 - right.dot(plane.coefficients), 0.0) / static_cast<double>(n));
  return true;
}

bool fit_background(const Pixels& ring, Plane& plane) {
  Plane first;
  return fit(ring, first, 1e9, first) &&
         fit(ring, first, kOutlierSigmas * first.sigma + 1.0, plane);
}

}  // namespace

Eigen::Vector2d dot_centre(const ImageView& image, const Region& region) {
  if (region.semi_major_px + kGrow_px + kRingWidth_px + 1.0 > kMaxReach_px)
    return region.centroid_px;
  Pixels dot;
  Pixels ring;
  collect(image, region, dot, ring);
  Plane background;
  if (!fit_background(ring, background)) return region.centroid_px;
  double light = 0.0;
  Vector2d moment = Vector2d::Zero();
  for (const Pixel& p : dot) {
    const double weight = background.residual(p);
    light += weight;
    moment += weight * Vector2d(p.x, p.y);
  }
  const Vector2d shift = moment / light;
  // At least a grey level on average; a NaN is not plausible either.
  const bool plausible = std::abs(light) >= static_cast<double>(dot.size()) &&
                         shift.norm() <= 0.5 * region.semi_minor_px;
  return plausible ? Vector2d(region.centroid_px + shift) : region.centroid_px;
}

}  // namespace dottrack::image
