// The slope of the light on a dot, from what several cameras show of it.

#include "app/core/tracking/shared_light.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <random>

#include "tests/unit/acquisition/synthetic_views.h"

namespace dottrack::tracking {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector3d kPlace_m(4.2, 2.7, 0.4);
constexpr std::size_t kCameras = 5;
constexpr double kShift_px2 = 3.5;     // of the centre, by a slope: that of a dot 8 px across
constexpr double kSlopeSigma = 0.004;  // a pixel
constexpr double kCentreSigma_px = 0.01;

class SharedLightTest : public testing::Test {
 protected:
  SharedLightTest() {
    for (const core::Camera& camera : acquisition::test::ceiling_cameras()) {
      rig_.cameras.push_back(camera);
    }
    rig_.target.dots.push_back({kPlace_m, 0.1, {}});
    placed_[0].place_m = kPlace_m;
    placed_[0].normal = Vector3d::UnitZ();
    placed_[0].diameter_m = 0.1;
    for (std::size_t i = 0; i < kCameras; ++i) show(i);
  }

  void show(std::size_t camera) {
    SeenDot& view = view_of(camera);
    view.any = true;
    view.flaw = core::DotFlaw::none;
    view.region.semi_major_px = view.region.semi_minor_px = 4.0;
    view.region.centroid_px = truth_px(camera);
    view.covariance_px2 = kCentreSigma_px * kCentreSigma_px * Matrix2d::Identity();
    view.light.information_px2 = Matrix2d::Identity() / (kSlopeSigma * kSlopeSigma);
    view.light.centre_by_slope_px2 = kShift_px2 * Matrix2d::Identity();
    view.light.slope_per_px.setZero();
    view.sighting.pixel = view.region.centroid_px;
    view.sighting.window = {1.0, 20.0};
    ASSERT_TRUE(estimation::add_line_of_sight(rig_.cameras[camera], view.sighting));
  }

  SeenDot& view_of(std::size_t camera) { return seen_.by_camera[camera][0]; }

  Vector2d truth_px(std::size_t camera) const {
    Vector2d pixel = Vector2d::Zero();
    EXPECT_EQ(geometry::project(rig_.cameras[camera].model, placed_[0].place_m, pixel, nullptr),
              geometry::OpticsStatus::ok);
    return pixel;
  }

  // The change of the light over a metre as a camera shows it, by projecting the dot's plane.
  Vector2d slope_in(std::size_t camera, const Vector2d& per_m) const {
    constexpr double kStep_m = 1e-4;
    const std::array in_plane{Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY())};
    Matrix2d jacobian;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      Vector2d pixel;
      EXPECT_EQ(geometry::project(rig_.cameras[camera].model, kPlace_m + kStep_m * in_plane[axis],
                                  pixel, nullptr),
                geometry::OpticsStatus::ok);
      jacobian.col(static_cast<int>(axis)) = (pixel - truth_px(camera)) / kStep_m;
    }
    return jacobian.inverse().transpose() * per_m;
  }

  void light(std::size_t camera, const Vector2d& slope_per_px) {
    SeenDot& view = view_of(camera);
    view.light.slope_per_px = slope_per_px;
    view.region.centroid_px = truth_px(camera) + kShift_px2 * slope_per_px;
  }

  void add_noise() {
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < kCameras; ++i) {
      view_of(i).light.slope_per_px += kSlopeSigma * Vector2d(normal(random_), normal(random_));
    }
  }

  double off_px(std::size_t camera) {
    return (view_of(camera).region.centroid_px - truth_px(camera)).norm();
  }

  void take_out() { take_out_uneven_light(rig_, placed_, seen_); }

  core::Rig rig_;
  PlacedDots placed_{};
  SeenDots seen_;
  std::mt19937 random_{1};
};

const Vector2d kPerMetre(1.5, -2.5);

TEST_F(SharedLightTest, TheShiftIsTakenOutInAllCameras) {
  for (std::size_t i = 0; i < kCameras; ++i) light(i, slope_in(i, kPerMetre));
  for (std::size_t i = 0; i < kCameras; ++i) ASSERT_GT(off_px(i), 0.05) << i;
  take_out();
  for (std::size_t i = 0; i < kCameras; ++i) {
    EXPECT_LT(off_px(i), 0.01) << i;
    EXPECT_EQ(view_of(i).sighting.pixel, view_of(i).region.centroid_px);
    EXPECT_GT(view_of(i).covariance_px2(0, 0), kCentreSigma_px * kCentreSigma_px);
    const Vector3d& from = view_of(i).sighting.line.ray.origin;
    EXPECT_LT(view_of(i).sighting.line.ray.direction.cross(kPlace_m - from).norm(), 1e-3) << i;
  }
}

TEST_F(SharedLightTest, NoiseHardlyMovesAnything) {
  constexpr int kTrials = 500;
  int moved = 0;
  double square = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    for (std::size_t i = 0; i < kCameras; ++i) show(i);
    add_noise();
    take_out();
    moved += off_px(0) > 0.0 ? 1 : 0;
    square += off_px(0) * off_px(0);
  }
  // Chi-square of 2 degrees of freedom is above 4 in 13.5 % of all cases.
  EXPECT_LT(moved, kTrials * 20 / 100);
  EXPECT_GT(moved, kTrials * 5 / 100);
  EXPECT_LT(std::sqrt(square / kTrials), 0.4 * kCentreSigma_px);
}

TEST_F(SharedLightTest, WhatIsLeftIsAsLargeAsTheCovarianceSays) {
  constexpr int kTrials = 500;
  double nees = 0.0;
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < kTrials; ++trial) {
    for (std::size_t i = 0; i < kCameras; ++i) {
      show(i);
      light(i, slope_in(i, kPerMetre));
      view_of(i).region.centroid_px += kCentreSigma_px * Vector2d(normal(random_), normal(random_));
    }
    add_noise();
    take_out();
    const SeenDot& view = view_of(0);
    const Vector2d off = view.region.centroid_px - truth_px(0);
    nees += off.dot(view.covariance_px2.inverse() * off);
  }
  // 2 is true; the part that all views share counts for as many as there are.
  EXPECT_LT(nees / kTrials, 2.3);
  EXPECT_GT(nees / kTrials, 0.4);
}

TEST_F(SharedLightTest, OneCameraAloneIsNotBelieved) {
  for (std::size_t i = 1; i < kCameras; ++i) view_of(i).any = false;
  light(0, slope_in(0, kPerMetre));
  const double before = off_px(0);
  take_out();
  EXPECT_EQ(off_px(0), before);
}

TEST_F(SharedLightTest, OneAgainstAllOthersHardlyCounts) {
  light(0, 5.0 * slope_in(0, kPerMetre));
  const Vector2d before = view_of(1).region.centroid_px;
  take_out();
  EXPECT_LT((view_of(1).region.centroid_px - before).norm(), 0.1 * off_px(0));
}

TEST_F(SharedLightTest, DistrustedCamerasAreNotAsked) {
  seen_.distrusted = CameraSet::first(kCameras);
  for (std::size_t i = 0; i < kCameras; ++i) light(i, slope_in(i, kPerMetre));
  const double before = off_px(0);
  take_out();
  EXPECT_EQ(off_px(0), before);
}

TEST_F(SharedLightTest, ADotWithoutANormalIsLeftAsItIs) {
  placed_[0].normal.setZero();
  for (std::size_t i = 0; i < kCameras; ++i) light(i, slope_in(i, kPerMetre));
  const double before = off_px(0);
  take_out();
  EXPECT_EQ(off_px(0), before);
}

TEST_F(SharedLightTest, AFlawThatTheSharedSlopeExplainsIsNoneAnyMore) {
  for (std::size_t i = 0; i < kCameras; ++i) light(i, slope_in(i, kPerMetre));
  SeenDot& shaded = view_of(2);
  shaded.flaw = core::DotFlaw::hidden;
  shaded.light.explains = true;
  shaded.light.covariance_px2 = shaded.covariance_px2;
  shaded.covariance_px2 += Matrix2d::Identity();
  SeenDot& covered = view_of(3);
  covered.flaw = core::DotFlaw::hidden;
  const double before = off_px(3);
  take_out();
  EXPECT_EQ(shaded.flaw, core::DotFlaw::none);
  EXPECT_LT(shaded.covariance_px2(0, 0), 0.01);
  EXPECT_LT(off_px(2), 0.01);
  EXPECT_EQ(covered.flaw, core::DotFlaw::hidden);
  EXPECT_EQ(off_px(3), before);
}

}  // namespace
}  // namespace dottrack::tracking
