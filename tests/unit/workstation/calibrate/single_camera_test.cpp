#include "app/workstation/calibrate/fit/single_camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <vector>

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Scene {
  geometry::Cahv truth;
  std::vector<Vector3d> points;
  std::vector<Vector2d> pixels;
};

geometry::Cahv looking(const Vector3d& from, const Vector3d& at, double focal_px,
                       const Vector2d& middle_px) {
  const Vector3d a = (at - from).normalized();
  const Vector3d right = a.cross(Vector3d::UnitZ()).normalized();
  const Vector3d down = a.cross(right);
  return {from, a, focal_px * right + middle_px.x() * a, focal_px * down + middle_px.y() * a};
}

Scene scene(std::size_t count, double thickness_m, double focal_px, double noise_px,
            unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> normal;
  Scene s;
  s.truth = looking({-3.0, -1.5, 4.0}, {0.0, 0.0, 0.0}, focal_px, {321.5, 237.25});
  while (s.points.size() < count) {
    const Vector3d p(1.5 * uniform(random), 1.5 * uniform(random), thickness_m * uniform(random));
    Vector2d pixel;
    if (project(s.truth, p, pixel) != geometry::OpticsStatus::ok) continue;
    s.points.push_back(p);
    s.pixels.push_back(pixel + noise_px * Vector2d(normal(random), normal(random)));
  }
  return s;
}

void expect_near(const geometry::Cahv& a, const geometry::Cahv& b, double tolerance) {
  EXPECT_LT((a.c - b.c).norm(), tolerance);
  EXPECT_LT((a.a - b.a).norm(), tolerance);
  EXPECT_LT((a.h - b.h).norm(), tolerance * 1000.0);
  EXPECT_LT((a.v - b.v).norm(), tolerance * 1000.0);
}

TEST(FitCahv, FindsTheCameraOfExactPoints) {
  for (const double focal_px : {300.0, 700.0, 6000.0}) {
    const Scene s = scene(12, 1.0, focal_px, 0.0, 1);
    const auto model = fit_cahv(s.points, s.pixels);
    ASSERT_TRUE(model) << focal_px;
    expect_near(*model, s.truth, 1e-5);
    EXPECT_FALSE(mirrored(*model));
    EXPECT_LT(rms_px(*model, s.points, s.pixels), 1e-6);
  }
}

TEST(FitCahv, IsUnitAndSquareWithNoise) {
  const Scene s = scene(60, 1.0, 700.0, 0.2, 2);
  const auto model = fit_cahv(s.points, s.pixels, {640, 480});
  ASSERT_TRUE(model);
  EXPECT_NEAR(model->a.norm(), 1.0, 1e-12);
  const Vector3d right = model->h - model->a.dot(model->h) * model->a;
  const Vector3d down = model->v - model->a.dot(model->v) * model->a;
  EXPECT_NEAR(right.normalized().dot(down.normalized()), 0.0, 1e-12);
  EXPECT_LT((model->c - s.truth.c).norm(), 0.02);
  EXPECT_LT(rms_px(*model, s.points, s.pixels), 0.3);
}

TEST(FitCahv, ManagesPointsThatAreNearlyInAPlane) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Scene s = scene(40, 0.1, 1500.0, 0.3, seed);
    const auto model = fit_cahv(s.points, s.pixels, {640, 480});
    ASSERT_TRUE(model) << seed;
    EXPECT_LT(rms_px(*model, s.points, s.pixels), 0.5) << seed;
    EXPECT_LT((model->c - s.truth.c).norm(), 0.3) << seed;
  }
}

TEST(FitCahv, FindsTheCameraOfATiltedPlane) {
  const Scene s = scene(20, 0.0, 700.0, 0.05, 3);
  EXPECT_FALSE(fit_cahv(s.points, s.pixels));  // the image's middle is needed
  const auto model = fit_cahv(s.points, s.pixels, {644, 476});
  ASSERT_TRUE(model);
  EXPECT_LT((model->c - s.truth.c).norm(), 0.05);
}

TEST(FitCahv, RefusesAPlaneSeenStraightOn) {
  Scene s = scene(20, 0.0, 700.0, 0.0, 4);
  const geometry::Cahv above{{0, 0, 5}, {0, 0, -1}, {700, 0, -320}, {0, -700, -240}};
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    ASSERT_EQ(project(above, s.points[i], s.pixels[i]), geometry::OpticsStatus::ok);
  }
  EXPECT_FALSE(fit_cahv(s.points, s.pixels, {641, 481}));
}

TEST(FitCahv, RefusesPointsOnALineAndTooFew) {
  Scene s = scene(12, 1.0, 700.0, 0.0, 5);
  EXPECT_FALSE(fit_cahv(std::span(s.points).first(5), std::span(s.pixels).first(5), {640, 480}));
  EXPECT_FALSE(fit_cahv(s.points, std::span(s.pixels).first(5)));
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    s.points[i] = {0.1 * static_cast<double>(i), 0.0, 0.0};
    ASSERT_EQ(project(s.truth, s.points[i], s.pixels[i]), geometry::OpticsStatus::ok);
  }
  EXPECT_FALSE(fit_cahv(s.points, s.pixels, {640, 480}));
}

TEST(FitCahv, SaysWhereThePointsAreMirrored) {
  Scene s = scene(30, 1.0, 700.0, 0.1, 6);
  for (Vector3d& p : s.points) p.x() = -p.x();
  const auto model = fit_cahv(s.points, s.pixels, {640, 480});
  ASSERT_TRUE(model);
  EXPECT_TRUE(mirrored(*model));
  EXPECT_LT(rms_px(*model, s.points, s.pixels), 0.2);
}

}  // namespace
}  // namespace dottrack::calibrate
