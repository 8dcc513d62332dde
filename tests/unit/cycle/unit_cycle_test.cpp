// The loop with what only a unit has: lamp, watchdog, recorded frames.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/cycle/cycle_fixture.h"

namespace dottrack::cycle::test {
namespace {

class UnitCycleTest : public CycleTest {
 protected:
  static std::vector<telemetry::FrameSize> sizes(const core::Rig& rig) {
    std::vector<telemetry::FrameSize> sizes;
    for (const core::Camera& camera : rig.cameras) {
      sizes.push_back({camera.width_px, camera.height_px});
    }
    return sizes;
  }

  FakeLine lamp_;
  FakeWatchdog watchdog_;
  telemetry::FrameRing frames_ring_{sizes(scene_.rig()), 2};
  Cycle unit_{{grabber_, iris_, can_, tracker_, clock_, stopwatch_, *ring_, &frames_ring_, &lamp_,
               &watchdog_},
              settings_for(scene_.rig(), kPeriod)};
};

TEST_F(UnitCycleTest, TheLampBlinksWhileSearchingAndShinesWhileTracking) {
  for (int n = 0; n < 3; ++n) unit_.tick(timer_.wait());
  EXPECT_THAT(lamp_.states, testing::ElementsAre(true, false, true));
  show(0);
  for (int n = 0; n < 3; ++n) unit_.tick(timer_.wait());
  EXPECT_THAT(lamp_.states, testing::ElementsAre(true, false, true, true, true, true));
  unit_.farewell(clock_.now());
  EXPECT_FALSE(lamp_.states.back());
}

TEST_F(UnitCycleTest, EveryTickKicksTheWatchdog) {
  for (int n = 0; n < 4; ++n) unit_.tick(timer_.wait());
  EXPECT_EQ(watchdog_.kicks, 4);
}

TEST_F(UnitCycleTest, TheFramesOfATickAreKeptAndAFullRingIsCounted) {
  show(0);
  for (int n = 0; n < 3; ++n) unit_.tick(timer_.wait());
  const telemetry::FrameCopy* copy = frames_ring_.front();
  ASSERT_NE(copy, nullptr);
  EXPECT_EQ(copy->delivered, CameraSet::first(kCameras));
  EXPECT_EQ(copy->frames[2].image.at(11, 7), shown_[2].view().at(11, 7));
  telemetry::CycleRecord record;
  while (ring_->try_pop(record)) continue;
  EXPECT_EQ(record.counters.frames_dropped, 1U);
}

}  // namespace
}  // namespace dottrack::cycle::test
