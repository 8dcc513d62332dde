#include "tests/board/harness/exposure_matching.h"

#include <gtest/gtest.h>

#include <array>

namespace dottrack::board {
namespace {

using std::chrono::milliseconds;

Time at(int ms) {
  return Time(milliseconds(ms));
}

const std::array<host_sim::Barrier, 3> kBarriers{
    {{0, 0.0, at(1000)}, {1, 0.4, at(1400)}, {2, 0.8, at(1800)}}};
constexpr Duration kExposure = milliseconds(20);
constexpr Duration kReach = milliseconds(180);

TEST(ExposureMatching, TakesTheNearestAndTellsHowFarItIs) {
  const auto match = match_exposure(at(1395), kBarriers, kExposure, kReach);
  ASSERT_TRUE(match);
  EXPECT_EQ(match->barrier.index, 1U);
  EXPECT_EQ(match->late, milliseconds(5));  // the middle is half an exposure before the release
}

TEST(ExposureMatching, AStampMayBeEarly) {
  const auto match = match_exposure(at(1750), kBarriers, kExposure, kReach);
  ASSERT_TRUE(match);
  EXPECT_EQ(match->barrier.index, 2U);
  EXPECT_EQ(match->late, milliseconds(-40));
}

TEST(ExposureMatching, FarFromEveryExposureIsNone) {
  EXPECT_FALSE(match_exposure(at(2100), kBarriers, kExposure, kReach));
  EXPECT_FALSE(match_exposure(at(1190), kBarriers, kExposure, milliseconds(150)));
  EXPECT_FALSE(match_exposure(at(1000), {}, kExposure, kReach));
}

}  // namespace
}  // namespace dottrack::board
