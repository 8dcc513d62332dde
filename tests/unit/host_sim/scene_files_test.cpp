#include "host_sim/scenarios/scene_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "app/config/rig_file.h"
#include "host_sim/scenarios/scenario_file.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::host_sim {
namespace {

namespace fs = std::filesystem;

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Scene scene_with(const std::string& lens) {
  const auto scene = parse_scenario(
      "[scenario]\nname = \"small\"\nticks = 3\nframe_rate_hz = 12.5\n[motion]\nkind = \"stand\"\n"
      "at = [0.0, 0.0]\n[cameras]\ncount = 6\nlens = \"" +
          lens + "\"\n[dots]\nmin_contrast_dn = 31\ndistance_m = [1.5, 17.0]\n",
      "small.toml");
  if (!scene) throw std::runtime_error(scene.error().message);
  return *scene;
}

TEST(SceneFilesTest, TheRigIsOneTheTrackerLoads) {
  for (const char* lens : {"pinhole", "radial", "fisheye"}) {
    const test::TemporaryFolder folder;
    const Scene scene = scene_with(lens);
    ASSERT_TRUE(write_rig(scene, folder.path() / "rig"));
    const auto rig = config::load_rig(folder.path() / "rig/rig.toml");
    ASSERT_TRUE(rig) << rig.error().message;
    EXPECT_EQ(rig->frame_rate_hz, 12.5);
    ASSERT_EQ(rig->cameras.size(), 6U);
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
      EXPECT_EQ(rig->cameras[i].name, scene.cameras[i].name);
      EXPECT_EQ(rig->rig.cameras[i].width_px, 640);
      EXPECT_EQ(rig->rig.cameras[i].min_contrast_dn, 31);
      EXPECT_EQ(rig->rig.cameras[i].distance_max_m, 17.0);
    }
    ASSERT_EQ(rig->rig.target.dots.size(), scene.target.size());
    for (std::size_t i = 0; i < scene.target.size(); ++i) {
      EXPECT_EQ(rig->rig.target.dots[i].position_m, scene.target[i].centre_m);
      EXPECT_EQ(rig->rig.target.dots[i].diameter_m, scene.target[i].diameter_m);
    }
  }
}

TEST(SceneFilesTest, OtherModelsMayBeToldThanTheTruth) {
  const test::TemporaryFolder folder;
  const Scene scene = scene_with("radial");
  std::vector<SimCamera> told;
  for (const SceneCamera& camera : scene.cameras) {
    told.emplace_back(camera.camera.centre_m() + Eigen::Vector3d(0.01, 0.0, 0.0),
                      camera.camera.rotation(), camera.camera.lens(), 640, 480);
  }
  ASSERT_TRUE(write_rig(scene, folder.path() / "true"));
  ASSERT_TRUE(write_rig(scene, folder.path() / "told", told));
  EXPECT_NE(contents(folder.path() / "true/cam1.cahvor"), "");
  EXPECT_NE(contents(folder.path() / "true/cam1.cahvor"),
            contents(folder.path() / "told/cam1.cahvor"));
}

TEST(SceneFilesTest, ModelsMayComeFromACalibration) {
  const test::TemporaryFolder folder;
  const Scene scene = scene_with("radial");
  for (const SceneCamera& camera : scene.cameras) {
    folder.write("models/" + camera.name + ".cahv", "the model of " + camera.name);
  }
  const fs::path rig = folder.path() / "rig";
  ASSERT_TRUE(write_calibrated_rig(scene, rig, folder.path() / "models"));
  for (const SceneCamera& camera : scene.cameras) {
    EXPECT_EQ(contents(rig / (camera.name + ".cahv")), "the model of " + camera.name);
    EXPECT_NE(contents(rig / "rig.toml").find("model = \"" + camera.name + ".cahv\""),
              std::string::npos);
  }
  fs::remove(folder.path() / "models" / (scene.cameras[1].name + ".cahv"));
  const auto result = write_calibrated_rig(scene, rig, folder.path() / "models");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find(scene.cameras[1].name), std::string::npos);
  EXPECT_NE(result.error().message.find("models"), std::string::npos);
}

TEST(SceneFilesTest, APgmIsItsHeaderAndItsPixelsRowByRow) {
  const test::TemporaryFolder folder;
  const std::vector<std::uint8_t> pixels{1, 2, 3, 99, 4, 5, 6, 99};
  ASSERT_TRUE(write_pgm(folder.path() / "a.pgm", {pixels.data(), 3, 2, 4}));
  EXPECT_EQ(contents(folder.path() / "a.pgm"), "P5\n3 2\n255\n\1\2\3\4\5\6");
}

TEST(SceneFilesTest, SaysWhichFileItCannotWrite) {
  const test::TemporaryFolder folder;
  folder.write("taken", "a file where a folder should be");
  const auto result = write_rig(scene_with("radial"), folder.path() / "taken");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("taken"), std::string::npos);
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace dottrack::host_sim
