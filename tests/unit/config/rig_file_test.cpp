#include "app/config/rig_file.h"

#include <gtest/gtest.h>

#include "tests/unit/config/good_rig.h"

namespace dottrack::config {
namespace {

using test::kGoodRig;
using test::replaced;
using test::RigFolder;

RigConfig load_or_fail(const std::filesystem::path& rig) {
  Result<RigConfig> config = load_rig(rig);
  if (!config) throw std::runtime_error(config.error().message);
  return *config;
}

TEST(RigFile, ReadsEveryKeyOfTheRigAndItsTarget) {
  const RigFolder folder;
  const RigConfig config = load_or_fail(folder.rig());
  EXPECT_EQ(config.name, "sandbox");
  EXPECT_EQ(config.frame_rate_hz, 25.0);
  EXPECT_EQ(config.target_name, "rover");
  EXPECT_FALSE(config.rig.target.upright);
  EXPECT_EQ(config.rig.target.max_step_m, 0.3);
  EXPECT_EQ(config.rig.target.dots.size(), 3U);
  EXPECT_EQ(config.rig.target.dots[2].position_m, Eigen::Vector3d(0.0, 0.7, 0.6));
  EXPECT_EQ(config.rig.limits.max_rms_residual_m, 0.01);
  EXPECT_EQ(config.rig.limits.lost_after_ticks, 7);
}

TEST(RigFile, ReadsEveryKeyOfACamera) {
  const RigFolder folder;
  const RigConfig config = load_or_fail(folder.rig());
  ASSERT_EQ(config.cameras.size(), 2U);
  ASSERT_EQ(config.rig.cameras.size(), 2U);
  EXPECT_EQ(config.cameras[0].name, "cam1");
  EXPECT_EQ(config.unit.cameras[0].device, "");
  EXPECT_EQ(config.cameras[1].name, "cam-2_b");
  EXPECT_EQ(config.unit.cameras[1].device, "/base/i2c/imx296@1");
  EXPECT_EQ(config.cameras[1].model_path, folder.path() / "models/cam2.cahv");
  const core::Camera& camera = config.rig.cameras[0];
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.height_px, 480);
  EXPECT_EQ(camera.distance_min_m, 2.0);
  EXPECT_EQ(camera.distance_max_m, 14.0);
  EXPECT_EQ(camera.intensity_min_dn, 128);
  EXPECT_EQ(camera.intensity_max_dn, 250);
  EXPECT_EQ(camera.min_contrast_dn, 9);
  EXPECT_EQ(camera.background_px, 31);
  EXPECT_EQ(camera.polarity, core::Polarity::dark);
}

TEST(RigFile, ReadsTheCameraModelItself) {
  const RigFolder folder;
  const RigConfig config = load_or_fail(folder.rig());
  EXPECT_EQ(geometry::centre(config.rig.cameras[0].model), Eigen::Vector3d(2.0, 1.5, 5.0));
}

TEST(RigFile, HasADefaultForEveryKeyThatMayBeMissing) {
  const RigFolder folder;
  folder.write("rig.toml",
               "[[camera]]\nname = \"a\"\nmodel = \"cam1.cahv\"\ndistance_m = [2, 14]\n"
               "intensity_dn = [100, 255]\n"
               "[[camera]]\nname = \"b\"\nmodel = \"cam1.cahv\"\ndistance_m = [2, 14]\n"
               "min_contrast_part = 0.25\n"
               "[target]\ndots = \"target.csv\"\n");
  const RigConfig config = load_or_fail(folder.rig());
  EXPECT_EQ(config.name, "rig");
  EXPECT_EQ(config.frame_rate_hz, 30.0);
  EXPECT_EQ(config.target_name, "target");
  EXPECT_TRUE(config.rig.target.upright);
  EXPECT_EQ(config.rig.target.max_step_m, 0.2);
  EXPECT_EQ(config.rig.limits.max_rms_residual_m, 0.02);
  EXPECT_EQ(config.rig.limits.lost_after_ticks, 5);
  const core::Camera& camera = config.rig.cameras[1];
  EXPECT_EQ(config.unit.cameras[1].device, "");
  EXPECT_EQ(camera.intensity_min_dn, 0);
  EXPECT_EQ(camera.intensity_max_dn, 255);
  EXPECT_EQ(config.rig.cameras[0].min_contrast_dn, 0);
  EXPECT_EQ(config.rig.cameras[0].min_contrast_part, 0.0);
  EXPECT_EQ(config.rig.cameras[1].min_contrast_part, 0.25);
  EXPECT_EQ(camera.background_px, 21);
  EXPECT_EQ(camera.polarity, core::Polarity::bright);
}

TEST(RigFile, TakesSixteenCameras) {
  const RigFolder folder;
  std::string text = "[target]\ndots = \"target.csv\"\n";
  for (int i = 0; i < 16; ++i) {
    text += "[[camera]]\nname = \"cam" + std::to_string(i) +
            "\"\nmodel = \"cam1.cahv\"\ndistance_m = [2, 14]\nmin_contrast_dn = 8\n";
  }
  folder.write("rig.toml", text);
  EXPECT_EQ(load_or_fail(folder.rig()).rig.cameras.size(), 16U);
}

TEST(RigFile, TakesLineEndsOfWindowsAndComments) {
  const RigFolder folder;
  std::string text = "# a comment\n" + std::string(kGoodRig);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) {
    text.insert(at, 1, '\r');
  }
  folder.write("rig.toml", text);
  EXPECT_EQ(load_or_fail(folder.rig()).name, "sandbox");
}

TEST(RigFile, TakesAWholeNumberForANumber) {
  const RigFolder folder;
  folder.write("rig.toml", replaced(kGoodRig, "frame_rate_hz = 25.0", "frame_rate_hz = 60"));
  EXPECT_EQ(load_or_fail(folder.rig()).frame_rate_hz, 60.0);
}

TEST(RigFile, TakesAnAbsolutePath) {
  const RigFolder folder;
  const std::string model = (folder.path() / "cam1.cahv").string();
  folder.write("elsewhere/rig.toml",
               replaced(replaced(replaced(kGoodRig, "cam1.cahv", model), "models/cam2.cahv", model),
                        "target.csv", (folder.path() / "target.csv").string()));
  EXPECT_EQ(load_or_fail(folder.path() / "elsewhere/rig.toml").rig.cameras.size(), 2U);
}

TEST(RigFile, LoadsTheSameTwice) {
  const RigFolder folder;
  const RigConfig first = load_or_fail(folder.rig());
  const RigConfig second = load_or_fail(folder.rig());
  EXPECT_EQ(first.cameras[1].name, second.cameras[1].name);
  EXPECT_EQ(geometry::centre(first.rig.cameras[1].model),
            geometry::centre(second.rig.cameras[1].model));
}

}  // namespace
}  // namespace dottrack::config
