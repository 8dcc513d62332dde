// The tracker on rendered scenes, whose truth is exact: it locks on the rover wherever it stands,
// and never on anything else. The margins are about three times what was measured.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/sim/scene_run.h"

namespace dottrack {
namespace {

using test::PoseError;
using test::SceneRun;

constexpr double kPosition_mm = 12.0;
constexpr double kAttitude_deg = 1.5;

// Five scenes a test, so that they can run side by side.
class RandomPlacements : public testing::TestWithParam<int> {};

TEST_P(RandomPlacements, LockWithinTwoTicksAndOnNothingElse) {
  for (int i = 0; i < 5; ++i) {
    const int seed = 5 * GetParam() + i + 1;
    const int dots = 4 + seed % 13;
    SceneRun run(host_sim::make_random_scene(
        {.seed = static_cast<std::uint64_t>(seed), .dots = dots, .cameras = 4 + seed % 3}));
    bool locked = false;
    for (std::uint64_t tick = 0; tick < 2; ++tick) {
      const core::TickResult& result = run.step(tick);
      if (!result.has_pose) continue;
      locked = true;
      const PoseError error = run.error(result, tick);
      EXPECT_LT(error.position_mm, kPosition_mm) << "seed " << seed << ", " << dots << " dots";
      EXPECT_LT(error.attitude_deg, kAttitude_deg) << "seed " << seed << ", " << dots << " dots";
    }
    EXPECT_TRUE(locked) << "seed " << seed << ", " << dots << " dots";
  }
}

INSTANTIATE_TEST_SUITE_P(Thirty, RandomPlacements, testing::Range(0, 6));

// Three dots among look-alikes may be taken for others: then no lock, rather than a wrong one.
TEST(ThreeDots, LockMostlyAndNeverWrongly) {
  constexpr int kScenes = 10;
  int locks = 0;
  for (int seed = 1; seed <= kScenes; ++seed) {
    SceneRun run(host_sim::make_random_scene(
        {.seed = 100U + static_cast<unsigned>(seed), .dots = 3, .cameras = 5}));
    const core::TickResult& result = run.step(0);
    if (!result.has_pose) continue;
    ++locks;
    EXPECT_FALSE(run.error(result, 0).wrong()) << "seed " << seed;
  }
  EXPECT_GE(locks, kScenes / 2);
}

// Nothing there but discs that look like dots: never a pose.
class EmptyScenes : public testing::TestWithParam<int> {};

TEST_P(EmptyScenes, NeverGiveAPose) {
  for (int i = 0; i < 4; ++i) {
    const int seed = 200 + 4 * GetParam() + i;
    SceneRun run(host_sim::make_random_scene({.seed = static_cast<std::uint64_t>(seed),
                                              .with_vehicle = false,
                                              .dots = 4 + i,
                                              .cameras = 5,
                                              .look_alikes = 40}));
    for (std::uint64_t tick = 0; tick < 2; ++tick) {
      const core::TickResult& result = run.step(tick);
      EXPECT_FALSE(result.has_pose) << "seed " << seed;
      const auto regions_seen =
          std::count_if(result.cameras.begin(), result.cameras.end(),
                        [](const core::CameraTick& camera) { return camera.regions >= 10; });
      EXPECT_GE(regions_seen, 4) << "the discs should be candidates, seed " << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Twelve, EmptyScenes, testing::Range(0, 3));

TEST(DemoScene, IsFollowedWhileCamerasFail) {
  SceneRun run(host_sim::make_demo_scene(2));
  for (std::uint64_t tick = 0; tick < 24; ++tick) {
    if (tick == 8) run.cover(0);
    if (tick == 12) run.cover(4);
    if (tick == 16) run.cover(2);
    const core::TickResult& result = run.step(tick);
    ASSERT_TRUE(result.has_pose) << "tick " << tick << ": " << to_string(result.reason);
    const PoseError error = run.error(result, tick);
    EXPECT_LT(error.position_mm, kPosition_mm) << tick;
    EXPECT_LT(error.attitude_deg, kAttitude_deg) << tick;
    EXPECT_EQ(result.reset_count, 1U) << tick;
  }
}

}  // namespace
}  // namespace dottrack
