#include "host_sim/renderer/cahvor_text.h"

#include <gtest/gtest.h>

#include <sstream>

#include "app/config/camera_file.h"
#include "app/core/geometry/camera_model.h"
#include "host_sim/scenarios/ceiling.h"
#include "host_sim/world/random.h"
#include "tests/unit/host_sim/cahvor_numbers.h"

namespace dottrack::host_sim {
namespace {

// What follows "key =" in the text.
Eigen::Vector3d numbers_of(const std::string& text, const std::string& key) {
  std::istringstream in(text.substr(text.find("\n" + key + " = ") + key.size() + 4));
  Eigen::Vector3d v;
  in >> v.x() >> v.y() >> v.z();
  EXPECT_TRUE(in) << key;
  return v;
}

TEST(CahvorTextTest, SaysTheSameLensInCahvorNumbers) {
  int seen = 0;
  for (const SceneCamera& scene_camera : ceiling_cameras({.seed = 3, .cameras = 8})) {
    const SimCamera& camera = scene_camera.camera;
    const std::string text = cahvor_text(camera, "a comment");
    const test::CahvorNumbers model{numbers_of(text, "C"), numbers_of(text, "A"),
                                    numbers_of(text, "H"), numbers_of(text, "V"),
                                    numbers_of(text, "O"), numbers_of(text, "R")};
    RandomStream random(5, 5);
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d p(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(0, 1));
      const auto pixel = camera.project(p);
      if (!pixel) continue;
      ++seen;
      EXPECT_LT((*pixel - test::project(model, p)).norm(), 1e-9);
    }
  }
  EXPECT_GE(seen, 200);
}

// The one place where the simulator's camera meets the tracker's: through the file.
TEST(CahvorTextTest, TheTrackersOwnReaderSeesTheSamePixels) {
  int seen = 0;
  for (const SceneCamera& scene_camera : ceiling_cameras({.seed = 4, .cameras = 8})) {
    const SimCamera& camera = scene_camera.camera;
    const auto file = config::parse_camera_text(cahvor_text(camera, "a comment"), "cam.cahvor");
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_TRUE(file->dimensions);
    EXPECT_EQ(file->dimensions->columns, camera.width_px());
    EXPECT_EQ(file->dimensions->rows, camera.height_px());
    RandomStream random(6, 6);
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector2d pixel(random.uniform(0, 639), random.uniform(0, 479));
      const auto direction = camera.direction(pixel);
      ASSERT_TRUE(direction);
      Eigen::Vector2d back;
      const auto status =
          geometry::project(file->model, camera.centre_m() + 6.0 * *direction, back);
      ASSERT_EQ(status, geometry::OpticsStatus::ok);
      EXPECT_LT((back - pixel).norm(), 1e-9);
      ++seen;
    }
  }
  EXPECT_EQ(seen, 800);
}

}  // namespace
}  // namespace dottrack::host_sim
