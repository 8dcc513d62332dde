#include "tests/board/harness/lighting.h"

#include <gtest/gtest.h>

namespace dottrack::board {
namespace {

// Camera i shows 100 (i + 1) grey values of fully open light.
void grey(std::span<const host_sim::Exposure> exposures, std::vector<host_sim::GreyImage>& images) {
  for (std::size_t i = 0; i < exposures.size(); ++i) {
    const double level = 100.0 * static_cast<double>(i + 1) * exposures[i].opening;
    images[i] = host_sim::GreyImage(4, 3, static_cast<std::uint8_t>(level));
  }
}

class LightingTest : public testing::Test {
 protected:
  void take_pictures() { source_(exposures_, images_); }

  Lighting lighting_{2};
  host_sim::PictureSource source_ = lighting_.light(grey);
  std::vector<host_sim::Exposure> exposures_{{.opening = 1.0}, {.opening = 0.5}};
  std::vector<host_sim::GreyImage> images_{2};
};

TEST_F(LightingTest, KnowsNothingBeforeTheFirstPicture) {
  EXPECT_EQ(lighting_.mean_dn(0), 0.0);
}

TEST_F(LightingTest, FullLightIsLeftAsItIs) {
  take_pictures();
  EXPECT_EQ(lighting_.mean_dn(0), 100.0);
  EXPECT_EQ(lighting_.mean_dn(1), 100.0);
}

TEST_F(LightingTest, DimmedLightDarkensEveryPicture) {
  lighting_.dim_to(0.25);
  take_pictures();
  EXPECT_EQ(lighting_.mean_dn(0), 25.0);
  EXPECT_EQ(lighting_.mean_dn(1), 25.0);
  EXPECT_EQ(images_[1].at(3, 2), 25);
}

}  // namespace
}  // namespace dottrack::board
