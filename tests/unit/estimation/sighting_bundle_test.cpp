#include "app/core/estimation/sighting_bundle.h"

#include <gtest/gtest.h>

#include <random>

#include "app/core/estimation/sighting.h"

namespace dottrack::estimation {
namespace {

constexpr DiameterRange kDots{0.08, 0.12};

core::Camera camera() {
  geometry::Cahvor model;
  model.c = Eigen::Vector3d::Zero();
  model.a = Eigen::Vector3d::UnitZ();
  model.h = {450.0, 0.0, 319.5};
  model.v = {0.0, 450.0, 239.5};
  model.o = model.a;
  model.r = {0.0, -0.03, 0.005};
  core::Camera result;
  result.model = model;
  result.width_px = 640;
  result.height_px = 480;
  result.distance_min_m = 2.0;
  result.distance_max_m = 14.0;
  return result;
}

// Of every number from one to a whole bundle.
TEST(SightingBundle, SaysOfManyWhatIsSaidOfOne) {
  const core::Camera seen = camera();
  const geometry::Optics optics(seen.model, seen.width_px, seen.height_px);
  std::mt19937 random(41);
  std::uniform_real_distribution<double> x(0.0, 639.0);
  std::uniform_real_distribution<double> y(0.0, 479.0);
  std::uniform_real_distribution<double> semi_major(0.5, 40.0);
  int described = 0;
  int refused = 0;
  for (std::size_t size = 1; size <= SightingBundle::kCapacity; ++size) {
    SightingBundle bundle;
    bundle.size = size;
    std::array<image::Region, SightingBundle::kCapacity> regions;
    for (std::size_t i = 0; i < size; ++i) {
      regions[i].centroid_px = {x(random), y(random)};
      regions[i].semi_major_px = i == 7 ? 1.0 : semi_major(random);  // 1: nothing but a rim
      bundle.semi_major_px[i] = regions[i].semi_major_px;
      bundle.least_px_per_rad[i] = optics.at(regions[i].centroid_px).min_px;
      bundle.most_px_per_rad[i] = optics.at(regions[i].centroid_px).max_px;
    }
    describe_sightings(kDots, {seen.distance_min_m, seen.distance_max_m}, bundle);
    for (std::size_t i = 0; i < size; ++i) {
      Sighting one;
      const bool any = describe_sighting(seen, optics, kDots, regions[i], one);
      ++(any ? described : refused);
      EXPECT_EQ(bundle.near_m[i] <= bundle.far_m[i], any);
      EXPECT_EQ(bundle.near_m[i], one.window.near_m);
      EXPECT_EQ(bundle.far_m[i], one.window.far_m);
      if (!any) continue;
      EXPECT_EQ(bundle.sigma_rad[i], one.line.sigma_rad);
      EXPECT_EQ(bundle.angular_diameter_rad[i], one.angular_diameter_rad);
    }
  }
  EXPECT_GT(described, 600);
  EXPECT_GT(refused, 600);
}

}  // namespace
}  // namespace dottrack::estimation
