// A scene's cameras as USB cameras.

#include "host_sim/usb_cameras/scene_cameras.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "host_sim/scenarios/scenario_file.h"
#include "host_sim/scenarios/scene_renderer.h"

namespace dottrack::host_sim {
namespace {

Scene small_scene() {
  const auto scene = parse_scenario(
      "[scenario]\nname = \"small\"\nticks = 3\n[motion]\nkind = \"drive\"\n"
      "way_points = [[-1, 0], [1, 0]]\nclosed = false\n"
      "[hall]\nrocks = 10\nlook_alikes = 4\nlander = false\nfurniture = false\n"
      "[cameras]\ncount = 2\nwidth_px = 64\nheight_px = 48\n",
      "small.toml");
  if (!scene) throw std::runtime_error(scene.error().message);
  return *scene;
}

TEST(SceneCamerasTest, TheSetupIsTheScenes) {
  const Scene scene = small_scene();
  const auto setup = setup_of(scene, "/run/cameras");
  ASSERT_TRUE(setup) << setup.error().message;
  EXPECT_EQ(setup->folder, "/run/cameras");
  EXPECT_THAT(setup->names, testing::ElementsAre(scene.cameras[0].name, scene.cameras[1].name));
  EXPECT_EQ(setup->width_px, 64);
  EXPECT_EQ(setup->height_px, 48);
  EXPECT_DOUBLE_EQ(setup->frame_rate_hz, scene.frame_rate_hz);
  EXPECT_DOUBLE_EQ(to_seconds(setup->exposure.exposure), scene.cameras[0].exposure_s);
}

TEST(SceneCamerasTest, CamerasOfDifferentSizesAreAnError) {
  Scene mixed = small_scene();
  const auto big = parse_scenario(
      "[scenario]\nname = \"big\"\nticks = 3\n[motion]\nkind = \"drive\"\n"
      "way_points = [[-1, 0], [1, 0]]\nclosed = false\n"
      "[cameras]\ncount = 2\nwidth_px = 80\nheight_px = 60\n",
      "big.toml");
  ASSERT_TRUE(big) << big.error().message;
  mixed.cameras[1] = big->cameras[1];
  const auto setup = setup_of(mixed, "/run/cameras");
  ASSERT_FALSE(setup);
  EXPECT_THAT(setup.error().message, testing::HasSubstr("80x60 pixels, expected 64x48"));
}

TEST(SceneCamerasTest, ThePicturesAreTheScenes) {
  const Scene scene = small_scene();
  const PictureSource pictures = pictures_of(scene, 1);
  SceneRenderer renderer(scene, 1);
  std::vector<Exposure> exposures(2);
  exposures[1].noise.camera = 1;
  std::vector<GreyImage> shown;
  std::vector<GreyImage> expected;
  pictures(exposures, shown);
  renderer.render(exposures, expected);
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_EQ(shown[1].pixels(), expected[1].pixels());
}

}  // namespace
}  // namespace dottrack::host_sim
