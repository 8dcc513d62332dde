// The one place where the simulator's camera meets the tracker's: through the file.

#include "host_sim/renderer/camera_text.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "app/config/camera_file.h"
#include "app/core/geometry/camera_model.h"
#include "host_sim/world/random.h"
#include "tests/unit/geometry/reference_rows.h"
#include "tests/unit/host_sim/jpl_camera.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Of all kinds, each with a skew and an axis of its own; fish-eyes of every sign of linearity.
std::vector<SimCamera> random_cameras(std::uint64_t seed) {
  std::vector<SimCamera> cameras;
  RandomStream random(seed, 7);
  for (int i = 0; i < 15; ++i) {
    const Vector3d centre{random.uniform(-9, 9), random.uniform(-4, 4), random.uniform(4, 6)};
    const Vector3d aim{random.uniform(-3, 3), random.uniform(-2, 2), 0.0};
    Lens lens;
    lens.kind = static_cast<LensKind>(i % 3);
    const bool bent = lens.kind == LensKind::fisheye;
    lens.focal_x_px = (bent ? 260.0 : 460.0) * random.uniform(0.9, 1.1);
    lens.focal_y_px = lens.focal_x_px * random.uniform(0.98, 1.02);
    lens.skew_px = random.uniform(-1.0, 1.0);
    lens.centre_x_px += random.uniform(-8.0, 8.0);
    lens.axis = {random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), 1.0};
    lens.radial = {random.uniform(-1e-3, 1e-3), random.uniform(-0.12, 0.05),
                   random.uniform(0.0, 0.02)};
    if (bent) lens.radial[1] *= 0.2;
    lens.linearity = (i / 3 - 2) * 0.3;
    lens.pupil_m = {random.uniform(0.0, 0.003), random.uniform(-0.001, 0.001), 1e-4};
    cameras.emplace_back(centre, looking_at(centre, aim, random.uniform(-0.3, 0.3)), lens, 640,
                         480);
  }
  for (const auto& reference : test::kReferenceCameras) {
    cameras.push_back(test::sim_camera(reference.model, 640, 480));
  }
  return cameras;
}

config::CameraFile read_back(const SimCamera& camera) {
  const auto file = config::parse_camera_text(camera_text(camera, "a comment"), "camera");
  if (!file) throw std::runtime_error(file.error().message);
  return *file;
}

TEST(CameraTextTest, TheTrackersReaderSeesTheKindTheSizeAndTheComment) {
  for (const SimCamera& camera : random_cameras(1)) {
    const config::CameraFile file = read_back(camera);
    const LensKind kind = camera.lens().kind;
    EXPECT_EQ(geometry::class_name(file.model), kind == LensKind::pinhole  ? "CAHV"
                                                : kind == LensKind::radial ? "CAHVOR"
                                                                           : "CAHVORE");
    ASSERT_TRUE(file.dimensions);
    EXPECT_EQ(file.dimensions->columns, 640);
    EXPECT_EQ(file.dimensions->rows, 480);
    EXPECT_EQ(file.comment, "a comment");
  }
}

TEST(CameraTextTest, TheTrackerProjectsToThePixelsTheSimulatorSees) {
  for (const SimCamera& camera : random_cameras(2)) {
    const geometry::CameraModel model = read_back(camera).model;
    RandomStream random(6, 6);
    for (int i = 0; i < 200; ++i) {
      const Vector2d pixel{random.uniform(-0.5, 639.5), random.uniform(-0.5, 479.5)};
      const auto sight = camera.sight(pixel);
      ASSERT_TRUE(sight);
      const Vector3d point =
          sight->origin + random.uniform(0.3, 15.0) * sight->direction.normalized();
      Vector2d back;
      ASSERT_EQ(geometry::project(model, point, back), geometry::OpticsStatus::ok);
      EXPECT_LT((back - pixel).norm(), 1e-9);
    }
  }
}

TEST(CameraTextTest, TheSimulatorProjectsToThePixelsTheTrackerSees) {
  for (const SimCamera& camera : random_cameras(3)) {
    const geometry::CameraModel model = read_back(camera).model;
    RandomStream random(7, 7);
    for (int i = 0; i < 200; ++i) {
      const Vector2d pixel{random.uniform(-0.5, 639.5), random.uniform(-0.5, 479.5)};
      geometry::Ray ray;
      ASSERT_EQ(geometry::unproject(model, pixel, ray), geometry::OpticsStatus::ok);
      const auto back = camera.project(ray.origin + random.uniform(0.3, 15.0) * ray.direction);
      ASSERT_TRUE(back);
      EXPECT_LT((*back - pixel).norm(), 1e-9);
      const auto sight = camera.sight(pixel);
      ASSERT_TRUE(sight);
      EXPECT_LT((sight->origin - ray.origin).norm(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace dottrack::host_sim
