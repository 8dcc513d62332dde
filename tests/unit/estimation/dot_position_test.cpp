#include "app/core/estimation/dot_position.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/unit/acquisition/synthetic_views.h"

namespace dottrack::estimation {
namespace {

using Eigen::Vector3d;

class DotPositionTest : public testing::Test {
 protected:
  // How the first n cameras see the dot, each view off by (dx, dy) pixels.
  Views see(std::size_t n, double noise_px, std::size_t odd = 99, double odd_px = 0.0) {
    std::normal_distribution<double> noise(0.0, noise_px);
    Views views;
    for (std::size_t i = 0; i < n; ++i) {
      const core::Camera& camera = cameras_[i];
      const geometry::Optics optics(camera.model, camera.width_px, camera.height_px);
      image::Region region;
      geometry::project(camera.model, dot_, region.centroid_px);
      const double range_m = (dot_ - geometry::centre(camera.model)).norm();
      region.semi_major_px = 0.05 / range_m * optics.at(region.centroid_px).mean_px();
      const int r = static_cast<int>(region.semi_major_px) + 1;
      const Eigen::Vector2i middle = region.centroid_px.array().round().cast<int>();
      region.x_min = static_cast<std::int16_t>(middle.x() - r);
      region.x_max = static_cast<std::int16_t>(middle.x() + r);
      region.y_min = static_cast<std::int16_t>(middle.y() - r);
      region.y_max = static_cast<std::int16_t>(middle.y() + r);
      region.centroid_px += Eigen::Vector2d(noise(random_), noise(random_));
      if (i == odd) region.centroid_px.x() += odd_px;
      EXPECT_TRUE(make_sighting(camera, optics, {0.1, 0.1}, region, sightings_[i]));
      views.push_back({i, &camera, &sightings_[i]});
    }
    return views;
  }

  std::vector<core::Camera> cameras_ = acquisition::test::ceiling_cameras();
  Vector3d dot_{4.1, 2.9, 0.5};
  std::array<Sighting, kMaxCameras> sightings_;
  std::mt19937 random_{12};
};

TEST_F(DotPositionTest, UsesEveryViewThatAgrees) {
  int dropped = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    DotPosition position;
    ASSERT_TRUE(locate_dot(see(5, 0.15), position));
    dropped += 5 - position.cameras.size();
    EXPECT_LT((position.position_m - dot_).norm(), 0.02);
  }
  EXPECT_LT(dropped, kTrials / 100);
}

TEST_F(DotPositionTest, AHalfHiddenDotsViewIsLeftOut) {
  int left_out = 0;
  constexpr int kTrials = 500;
  for (int trial = 0; trial < kTrials; ++trial) {
    DotPosition position;
    ASSERT_TRUE(locate_dot(see(5, 0.05, 2, 1.5), position));
    left_out += !position.cameras.contains(2);
  }
  EXPECT_GT(left_out, kTrials * 98 / 100);
}

TEST_F(DotPositionTest, OfThreeViewsNoneCanBeToldFromTheOthers) {
  DotPosition position;
  ASSERT_TRUE(locate_dot(see(3, 0.0, 1, 1.0), position));
  EXPECT_EQ(position.cameras.size(), 3);
}

TEST_F(DotPositionTest, OneViewIsNoPosition) {
  DotPosition position;
  EXPECT_FALSE(locate_dot(see(1, 0.0), position));
}

// Drops one view at a time until each sees the dot inside its box: by the camera's own projection.
bool locate_plainly(Views views, geometry::Triangulation& result) {
  for (;;) {
    StaticVector<geometry::SightLine, kMaxCameras> lines;
    for (const View& view : views) lines.push_back(view.sighting->line);
    if (geometry::triangulate(as_span(lines), result) != geometry::TriangulationStatus::ok) {
      return false;
    }
    double worst = 0.0;
    std::size_t odd = views.size();
    for (std::size_t i = 0; i < views.size(); ++i) {
      const Sighting& s = *views[i].sighting;
      Eigen::Vector2d pixel;
      geometry::project(views[i].model->model, result.point_m, pixel);
      const double excess = (pixel - s.pixel).norm() / (s.box_max_px - s.box_min_px).norm();
      if (s.box_contains(pixel) || excess <= worst) continue;
      worst = excess;
      odd = i;
    }
    if (odd == views.size()) return true;
    views.erase(views.begin() + static_cast<std::ptrdiff_t>(odd));
  }
}

TEST_F(DotPositionTest, NoViewIsKeptThatTheDotDoesNotProjectInto) {
  std::uniform_real_distribution<double> odd(-15.0, 15.0);
  int dropped = 0;
  constexpr int kTrials = 1000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Views views = see(3, 0.5, 1, odd(random_));
    geometry::Triangulation expected;
    DotPosition position;
    const bool found = locate_plainly(views, expected);
    ASSERT_EQ(locate_dot(views, position), found);
    if (!found) continue;
    EXPECT_EQ(position.position_m, expected.point_m);
    dropped += position.cameras.size() < 3 ? 1 : 0;
  }
  EXPECT_GT(dropped, kTrials / 10);
  EXPECT_LT(dropped, kTrials * 9 / 10);
}

}  // namespace
}  // namespace dottrack::estimation
