// [light] of a rig file, and what light control is told of it.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "app/config/light.h"
#include "tests/unit/config/good_rig.h"

namespace dottrack::config {
namespace {

using std::chrono::microseconds;

exposure::LightSettings settings_of(const std::string& more) {
  test::RigFolder folder;
  const auto rig = load_rig(folder.write("rig.toml", std::string(test::kGoodRig) + more));
  if (!rig) throw std::runtime_error(rig.error().message);
  return light_settings(*rig);
}

TEST(LightConfig, LeavesTheLightAloneUnlessAskedTo) {
  const exposure::LightSettings light = settings_of("");
  EXPECT_FALSE(light.on);
  EXPECT_NEAR(light.target_dn, 191.25, 1e-9);
  EXPECT_EQ(light.exposure_min, microseconds(50));
  EXPECT_EQ(light.exposure_max, microseconds(10000));
  EXPECT_EQ(light.delay_ticks, 4);
  EXPECT_EQ(light.start[0].exposure, microseconds(4000));
}

TEST(LightConfig, ReadsEveryKey) {
  const exposure::LightSettings light = settings_of(
      "\n[light]\ncontrol = true\ntarget_part = 0.6\nexposure_ms = [0.1, 5.0]\n"
      "gain = [2.0, 4.0]\ndelay_ticks = 3\nmax_blur_px = 0.8\n");
  EXPECT_TRUE(light.on);
  EXPECT_NEAR(light.target_dn, 153.0, 1e-9);
  EXPECT_EQ(light.exposure_min, microseconds(100));
  EXPECT_EQ(light.exposure_max, microseconds(5000));
  EXPECT_EQ(light.gain_min, 2.0);
  EXPECT_EQ(light.gain_max, 4.0);
  EXPECT_EQ(light.delay_ticks, 3);
  EXPECT_EQ(light.max_blur_px, 0.8);
}

}  // namespace
}  // namespace dottrack::config
