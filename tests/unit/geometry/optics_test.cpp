#include "app/core/geometry/optics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dottrack::geometry {
namespace {

// A pinhole of focal length f px looking along +z, principal point in the middle of 640 x 480.
CameraModel pinhole(double f) {
  Cahv model;
  model.c = {0.0, 0.0, 0.0};
  model.a = {0.0, 0.0, 1.0};
  model.h = {f, 0.0, 319.5};
  model.v = {0.0, f, 239.5};
  return model;
}

TEST(Optics, OfAPinholeIsFocalLengthOnAxis) {
  const Optics optics(pinhole(500.0), 640, 480);
  const AngularScale& scale = optics.at({319.5, 239.5});
  EXPECT_NEAR(scale.min_px, 500.0, 1.0);
  EXPECT_NEAR(scale.max_px, 500.0, 1.0);
}

TEST(Optics, OffAxisStretchesByTheCosineOnceAndTwice) {
  const Optics optics(pinhole(500.0), 640, 480);
  const Eigen::Vector2d pixel(629.5, 239.5);  // the middle of its cell in x
  const double cosine = 1.0 / std::hypot(1.0, (629.5 - 319.5) / 500.0);
  EXPECT_NEAR(optics.at(pixel).min_px, 500.0 / cosine, 2.0);
  EXPECT_NEAR(optics.at(pixel).max_px, 500.0 / (cosine * cosine), 4.0);
}

TEST(Optics, ExtremesBoundEveryCell) {
  const Optics optics(pinhole(400.0), 640, 480);
  for (int x = 0; x < 640; x += 16) {
    for (int y = 0; y < 480; y += 16) {
      EXPECT_GE(optics.at({x, y}).min_px, optics.extremes().min_px);
      EXPECT_LE(optics.at({x, y}).max_px, optics.extremes().max_px);
    }
  }
}

TEST(Optics, OutsideTheImageTakesTheNearestCell) {
  const Optics optics(pinhole(400.0), 640, 480);
  EXPECT_EQ(optics.at({-100.0, -5.0}).max_px, optics.at({0.0, 0.0}).max_px);
  EXPECT_EQ(optics.at({9999.0, 9999.0}).max_px, optics.at({639.0, 479.0}).max_px);
}

}  // namespace
}  // namespace dottrack::geometry
