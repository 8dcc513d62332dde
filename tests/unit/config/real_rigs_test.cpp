// The rigs of the real photographs load, with the numbers that their files say.

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "app/config/rig_file.h"
#include "tests/support/shared_data.h"

namespace dottrack::config {
namespace {

struct RealRig {
  std::string folder;
  std::size_t dots = 0;
  double max_step_m = 0.0;
};

void PrintTo(const RealRig& rig, std::ostream* out) {
  *out << rig.folder;
}

class RealRigs : public testing::TestWithParam<RealRig> {};

TEST_P(RealRigs, Loads) {
  const auto data = test::shared_data();
  if (!data) GTEST_SKIP() << "shared data absent: ../shared/data/real_target";
  const Result<RigConfig> config = load_rig(*data / "real_target" / GetParam().folder / "rig.toml");
  ASSERT_TRUE(config.has_value()) << config.error().message;
  EXPECT_EQ(config->name, GetParam().folder);
  ASSERT_EQ(config->rig.cameras.size(), 3U);
  EXPECT_EQ(config->cameras[2].name, "cam3");
  EXPECT_EQ(config->rig.cameras[0].width_px, 1280);
  EXPECT_EQ(config->rig.cameras[0].height_px, 1024);
  EXPECT_EQ(config->rig.cameras[0].min_contrast_dn, 8);
  EXPECT_EQ(config->rig.target.dots.size(), GetParam().dots);
  EXPECT_EQ(config->rig.target.max_step_m, GetParam().max_step_m);
  EXPECT_FALSE(config->rig.target.upright);
}

INSTANTIATE_TEST_SUITE_P(Photographs, RealRigs,
                         testing::Values(RealRig{"myptv_n5", 5, 0.0077},
                                         RealRig{"myptv_n8", 8, 0.0084}),
                         [](const auto& rig) { return rig.param.folder; });

}  // namespace
}  // namespace dottrack::config
