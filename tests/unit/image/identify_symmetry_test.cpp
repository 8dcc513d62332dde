// The ellipse of its own moments tells a dot from what is not symmetric or not filled.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "app/core/estimation/dot_size.h"
#include "app/core/image/identify.h"
#include "tests/unit/image/pictures.h"

namespace dottrack::image::test {
namespace {

constexpr int kSide = 64;
constexpr double kMiddle = kSide / 2.0;
constexpr int kParts = 3;  // of a pixel, each way

// Whether a point, in pixels from the shape's middle along its axes, lies in it.
using Shape = std::function<bool(double u, double v)>;

struct Scene {
  double x = kMiddle;
  double y = kMiddle;
  double angle_rad = 0.0;
  double blur_px = 0.5;
  double contrast_dn = 120.0;
  double noise_dn = 0.0;
};

class Canvas {
 public:
  Canvas(const Shape& shape, const Scene& scene) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) at(x, y) = covered(shape, scene, x, y);
    }
    blur(scene.blur_px, 1, 0);
    blur(scene.blur_px, 0, 1);
  }

  Picture exposed(const Scene& scene, Random& random) const {
    std::normal_distribution<double> noise(0.0, 1.0);
    Picture picture(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double grey =
            kGround_dn + scene.contrast_dn * pixels_[index(x, y)] + scene.noise_dn * noise(random);
        picture.at(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
      }
    }
    return picture;
  }

  static constexpr double kGround_dn = 40.0;

 private:
  static std::size_t index(int x, int y) {
    return static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
  }
  double& at(int x, int y) { return pixels_[index(x, y)]; }

  static double covered(const Shape& shape, const Scene& scene, int x, int y) {
    const double c = std::cos(scene.angle_rad);
    const double s = std::sin(scene.angle_rad);
    int inside = 0;
    for (int j = 0; j < kParts; ++j) {
      for (int i = 0; i < kParts; ++i) {
        const double dx = x + (i - kParts / 2) / double{kParts} - scene.x;
        const double dy = y + (j - kParts / 2) / double{kParts} - scene.y;
        inside += shape(c * dx + s * dy, c * dy - s * dx);
      }
    }
    return inside / double{kParts * kParts};
  }

  void blur(double sigma_px, int step_x, int step_y) {
    const std::array<double, kSide* kSide> sharp = pixels_;
    double total = 0.0;
    for (int k = -4; k <= 4; ++k) total += std::exp(-k * k / (2.0 * sigma_px * sigma_px));
    for (int y = 4; y < kSide - 4; ++y) {
      for (int x = 4; x < kSide - 4; ++x) {
        double sum = 0.0;
        for (int k = -4; k <= 4; ++k) {
          const double weight = std::exp(-k * k / (2.0 * sigma_px * sigma_px));
          sum += weight * sharp[index(x + k * step_x, y + k * step_y)];
        }
        at(x, y) = sum / total;
      }
    }
  }

  std::array<double, kSide * kSide> pixels_{};
};

class Symmetry : public testing::Test {
 protected:
  // The largest region, whatever its size and shape.
  Region seen(const Shape& shape, const Scene& scene, double threshold) {
    const Picture picture = Canvas(shape, scene).exposed(scene, random_);
    const int lo = static_cast<int>(Canvas::kGround_dn + threshold * scene.contrast_dn);
    identifier_.identify(picture.view(), {.intensity_min_dn = lo}, {.min_area_px = 3}, *regions_);
    Region largest;
    for (const Region& region : *regions_) {
      if (region.area_px > largest.area_px) largest = region;
    }
    return largest;
  }

  // At many angles and places; returns how many of them the gate of a dot refuses.
  int refused(const Shape& shape, int count) {
    int refusals = 0;
    for (int i = 0; i < count; ++i) {
      Scene scene;
      scene.x += real(random_, -0.5, 0.5);
      scene.y += real(random_, -0.5, 0.5);
      scene.angle_rad = real(random_, 0.0, 2.0 * std::numbers::pi);
      const Region region = seen(shape, scene, 0.5);
      EXPECT_GE(region.area_px, 50);
      refusals += misfit_left_px(region) < 0.0 || lack_left_px(region) < 0.0;
    }
    return refusals;
  }

  // How far the region is from being refused.
  double misfit_left_px(const Region& region) const {
    return gate_.max_box_misfit_px + gate_.max_box_misfit_part * region.semi_major_px -
           region.box_misfit_px;
  }
  double lack_left_px(const Region& region) const {
    const double ellipse = std::numbers::pi * region.semi_major_px * region.semi_minor_px;
    return gate_.max_lack_px - (1.0 - region.area_px / ellipse) * region.semi_minor_px;
  }

  Random random_{314};
  RegionGate gate_ = estimation::dot_gate({}, {1.0, 30.0});
  Identifier identifier_;
  std::unique_ptr<Regions> regions_ = std::make_unique<Regions>();
};

TEST_F(Symmetry, NoEllipseIsRefused) {
  int ellipses = 0;
  double misfit_left = 1e9;
  double lack_left = 1e9;
  for (int i = 0; i < 300; ++i) {
    const double a = real(random_, 1.5, 15.0);
    const double b = a * real(random_, 0.2, 1.0);
    Scene scene;
    scene.x += real(random_, -0.5, 0.5);
    scene.y += real(random_, -0.5, 0.5);
    scene.angle_rad = real(random_, 0.0, std::numbers::pi);
    scene.blur_px = real(random_, 0.3, 1.2);
    scene.noise_dn = scene.contrast_dn / real(random_, 8.0, 50.0);
    const Region region =
        seen([a, b](double u, double v) { return std::hypot(u / a, v / b) <= 1.0; }, scene,
             real(random_, 0.3, 0.6));
    if (region.area_px < 3) continue;  // too thin for its blur
    misfit_left = std::min(misfit_left, misfit_left_px(region));
    lack_left = std::min(lack_left, lack_left_px(region));
    ++ellipses;
  }
  EXPECT_GT(ellipses, 270);
  EXPECT_GT(misfit_left, 0.1);
  EXPECT_GT(lack_left, 0.05);
}

TEST_F(Symmetry, ShapesThatAreNotEllipsesAreRefused) {
  constexpr int kViews = 20;
  const auto disc = [](double u, double v, double r) { return std::hypot(u, v) <= r; };
  EXPECT_EQ(refused([&](double u, double v) { return disc(u, v, 14) && !disc(u, v, 9); }, kViews),
            kViews);  // a ring
  EXPECT_EQ(
      refused([&](double u, double v) { return disc(u, v, 14) && !disc(u - 7, v, 14); }, kViews),
      kViews);  // a crescent
  EXPECT_EQ(refused([&](double u, double v) { return disc(u, v, 28) && v > 0.0; }, kViews),
            kViews);  // half a disc
  EXPECT_EQ(refused([&](double u, double v) { return disc(u - 12, v, 12) || disc(u + 12, v, 12); },
                    kViews),
            kViews);  // two dots
  EXPECT_EQ(refused(
                [](double u, double v) {
                  return std::max(std::abs(u), std::abs(v)) <= 12 && (u < -4 || v < -4);
                },
                kViews),
            kViews);  // an L
  EXPECT_EQ(refused(
                [&](double u, double v) {
                  return (std::abs(u) <= 18 && std::abs(v) <= 3) || disc(u - 12, v, 6);
                },
                kViews),
            kViews);  // a bar with a bulge
}

}  // namespace
}  // namespace dottrack::image::test
