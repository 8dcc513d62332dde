#include "app/core/acquisition/point_filter.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/unit/acquisition/room_views.h"

namespace dottrack::acquisition {
namespace {

constexpr double kDiameter_m = 0.1;

// Cameras of all three models, small and large.
std::vector<core::Camera> mixed_cameras() {
  std::vector<core::Camera> cameras = test::room_cameras();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    auto plain = std::get<geometry::Cahv>(cameras[i].model);
    if (i % 4 == 3) {
      cameras[i].width_px = 1920;
      cameras[i].height_px = 1200;
      plain.h = 2.5 * (plain.h - 319.5 * plain.a) + 959.5 * plain.a;
      plain.v = 2.5 * (plain.v - 239.5 * plain.a) + 599.5 * plain.a;
      cameras[i].model = plain;
    }
    if (i % 3 == 1) {
      const Eigen::Vector3d axis = (plain.a + 2e-5 * plain.h).normalized();
      cameras[i].model =
          geometry::Cahvor{plain.c, plain.a, plain.h, plain.v, axis, {0.001, -0.08, 0.02}};
    }
    if (i == 5) {
      cameras[i].model = geometry::Cahvore{plain.c, plain.a, plain.h, plain.v, plain.a};
    }
  }
  return cameras;
}

TEST(PointFilter, MissesNoSightingThatIsClose) {
  std::mt19937 random(9);
  const std::vector<core::Camera> cameras = mixed_cameras();
  std::vector<CameraView> views(cameras.size());
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    test::add_clutter(cameras[c], 300, kDiameter_m, random, views[c]);
  }
  views[2].sightings.clear();
  const auto filter = std::make_unique<PointFilter>();
  filter->start(views);
  std::array<int, kMaxCameras> close{};
  std::array<int, kMaxCameras> passed{};
  std::vector<CandidatePair> pairs;
  std::vector<CameraSet> looks;
  constexpr int kPoints = 20000;
  for (const Eigen::Vector3d& point : test::points_in_hall(kPoints, random)) {
    const CameraSet look = filter->look(point);
    pairs.push_back({.point_m = point});
    looks.push_back(look);
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      passed[c] += look.contains(c) ? 1 : 0;
      Eigen::Vector2d pixel;
      if (geometry::project(cameras[c].model, point, pixel) != geometry::OpticsStatus::ok) continue;
      for (const estimation::Sighting& s : views[c].sightings) {
        if ((s.pixel - pixel).cwiseAbs().maxCoeff() > kClose_px) continue;
        ++close[c];
        EXPECT_TRUE(look.contains(c)) << "camera " << c;
        break;
      }
    }
  }
  std::vector<CameraSet> of_pairs(pairs.size());
  filter->look(pairs, of_pairs);
  EXPECT_EQ(of_pairs, looks);
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    if (c == 2) {
      EXPECT_EQ(passed[c], 0);
      continue;
    }
    EXPECT_GT(close[c], 10) << "camera " << c;
    if (c == 5) {
      EXPECT_EQ(passed[c], kPoints);  // CAHVORE is not looked at
    } else {
      EXPECT_LT(passed[c], 3 * close[c] + 100) << "camera " << c;
    }
  }
}

}  // namespace
}  // namespace dottrack::acquisition
