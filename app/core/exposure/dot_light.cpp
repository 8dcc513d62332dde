#include "app/core/exposure/dot_light.h"

#include <algorithm>
#include <cmath>

#include "app/core/exposure/grey_histogram.h"

namespace dottrack::exposure {
namespace {

constexpr std::uint8_t kFullScale_dn = 255;
constexpr double kCore = 0.8;     // of the axes: what blur does not darken
constexpr double kRim_px = 1.5;   // that blur brightens around the dot
constexpr double kRing_px = 4.0;  // the surround's width beyond that
constexpr double kReach_px = 40.0;
constexpr int kStride_px = 8;

// a x^2 + 2 b x y + c y^2 <= 1 inside an ellipse about the origin.
struct Ellipse {
  Ellipse(const DotSpot& spot, double scale, double grow_px) {
    const double cosine = std::cos(spot.angle_rad);
    const double sine = std::sin(spot.angle_rad);
    const double major = std::max(scale * spot.semi_major_px + grow_px, 0.75);
    const double minor = std::max(scale * spot.semi_minor_px + grow_px, 0.75);
    const double m = 1.0 / (major * major);
    const double n = 1.0 / (minor * minor);
    a = cosine * cosine * m + sine * sine * n;
    b = cosine * sine * (m - n);
    c = sine * sine * m + cosine * cosine * n;
  }

  bool contains(double x, double y) const { return a * x * x + 2.0 * b * x * y + c * y * y <= 1.0; }

  double a;
  double b;
  double c;
};

struct Box {
  int x_min;
  int y_min;
  int x_max;  // both ends included
  int y_max;
};

Box box_around(const ImageView& image, const DotSpot& spot) {
  const double reach = std::min(spot.semi_major_px + kRim_px + kRing_px, kReach_px);
  const auto low = [&](double at) { return std::max(static_cast<int>(std::floor(at - reach)), 0); };
  const auto high = [&](double at, int size) {
    return std::min(static_cast<int>(std::ceil(at + reach)), size - 1);
  };
  return {low(spot.centre_px.x()), low(spot.centre_px.y()),
          high(spot.centre_px.x(), image.width_px), high(spot.centre_px.y(), image.height_px)};
}

bool near(const ImageView& image, const DotSpot& spot) {
  const auto within = [](double at, int size) { return at > -kReach_px && at < size + kReach_px; };
  return !image.empty() && within(spot.centre_px.x(), image.width_px) &&
         within(spot.centre_px.y(), image.height_px);
}

}  // namespace

DotLight measure_dot(const ImageView& image, const DotSpot& spot) {
  if (!near(image, spot)) return {};
  const Ellipse core(spot, kCore, 0.0);
  const Ellipse rim(spot, 1.0, kRim_px);
  const Ellipse ring(spot, 1.0, kRim_px + kRing_px);
  const Box box = box_around(image, spot);
  GreyHistogram inside;
  GreyHistogram around;
  for (int y = box.y_min; y <= box.y_max; ++y) {
    for (int x = box.x_min; x <= box.x_max; ++x) {
      const double dx = x - spot.centre_px.x();
      const double dy = y - spot.centre_px.y();
      if (core.contains(dx, dy)) {
        inside.add(image.at(x, y));
      } else if (!rim.contains(dx, dy) && ring.contains(dx, dy)) {
        around.add(image.at(x, y));
      }
    }
  }
  return {.inside_px = static_cast<int>(inside.size()),
          .peak_dn = inside.percentile_dn(0.9),
          .saturated_px = static_cast<int>(inside.at(kFullScale_dn)),
          .saturated_around_px = static_cast<int>(around.at(kFullScale_dn)),
          .surround_dn = around.percentile_dn(0.5),
          .noise_dn = (around.percentile_dn(0.84) - around.percentile_dn(0.16) + 1) / 2};
}

ImageLight measure_image(const ImageView& image) {
  GreyHistogram greys;
  for (int y = kStride_px / 2; y < image.height_px; y += kStride_px) {
    for (int x = kStride_px / 2; x < image.width_px; x += kStride_px) greys.add(image.at(x, y));
  }
  if (greys.size() == 0) return {};
  return {greys.mean_dn(), greys.percentile_dn(0.99),
          static_cast<double>(greys.at(kFullScale_dn)) / greys.size()};
}

}  // namespace dottrack::exposure
