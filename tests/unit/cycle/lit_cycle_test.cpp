// The loop that sets its cameras' light.

#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>

#include "tests/unit/cycle/cycle_fixture.h"

namespace dottrack::cycle::test {
namespace {

using exposure::LightState;

class LitCycleTest : public CycleTest {
 protected:
  static exposure::LightSettings settings() {
    exposure::LightSettings settings{.on = true};
    settings.start.fill({milliseconds(2), 1.0});
    return settings;
  }

  LitCycleTest() {
    grabber_.takes_exposures = true;
    iris_.takes_moves = true;
    lit_.emplace(CycleParts{.grabber = grabber_,
                            .iris = iris_,
                            .can = can_,
                            .tracker = tracker_,
                            .clock = clock_,
                            .stopwatch = stopwatch_,
                            .records = *ring_,
                            .light = &light_},
                 settings_for(scene_.rig(), kPeriod));
  }

  const telemetry::CycleRecord& lit_tick() {
    lit_->tick(timer_.wait());
    if (!ring_->try_pop(record_)) throw std::runtime_error("the tick left no record");
    return record_;
  }

  // The drive's first ticks, every dot as bright as share of how it is drawn.
  void drive(std::uint64_t ticks, double share) {
    for (std::uint64_t n = 0; n < ticks; ++n) {
      show(n);
      for (std::size_t i = 0; i < kCameras; ++i) dim(i, share);
      lit_tick();
      ASSERT_TRUE(record_.result.has_pose) << "tick " << n;
    }
  }

  void dim(std::size_t camera, double share) {
    for (std::uint8_t& pixel : shown_[camera].pixels) {
      pixel = static_cast<std::uint8_t>(share * pixel);
    }
    grabber_.images[camera] = shown_[camera].view();
  }

  exposure::LightControl light_{scene_.rig(), settings()};
  std::optional<Cycle> lit_;
};

TEST_F(LitCycleTest, DarkDotsMakeEveryCameraExposeLonger) {
  drive(3, 0.6);
  for (std::size_t i = 0; i < kCameras; ++i) {
    ASSERT_TRUE(grabber_.exposures[i]) << "camera " << i;
    EXPECT_GT(grabber_.exposures[i]->exposure, milliseconds(2)) << "camera " << i;
    EXPECT_EQ(record_.light[i].setting.exposure, grabber_.exposures[i]->exposure);
    EXPECT_EQ(record_.light[i].setting.gain, grabber_.exposures[i]->gain);
    EXPECT_GT(record_.light[i].peak_dn, 0);
  }
}

TEST_F(LitCycleTest, TakesTheIrisesOverWhereTheyStand) {
  drive(1, 0.9);
  for (std::size_t i = 0; i < kCameras; ++i) {
    EXPECT_EQ(iris_.moves[i], 1) << "camera " << i;
    EXPECT_EQ(iris_.openings[i], FakeIris::kAutomatic) << "camera " << i;
  }
  EXPECT_EQ(iris_.moves[kCameras], 0) << "no camera of the rig";
}

TEST_F(LitCycleTest, ARefusedSettingIsNotTakenForTheCameras) {
  grabber_.takes_exposures = false;
  drive(3, 0.6);
  ASSERT_TRUE(grabber_.exposures[0]);
  EXPECT_NE(grabber_.exposures[0]->exposure, milliseconds(2));
  EXPECT_EQ(record_.light[0].setting.exposure, milliseconds(2));
}

TEST_F(LitCycleTest, AnIrisThatDoesNotAnswerIsNamedAndTheOthersGoOn) {
  iris_.broken.insert(2);
  drive(3, 0.6);
  EXPECT_EQ(record_.light[2].state, LightState::iris_fault);
  EXPECT_TRUE(record_.unhealthy_irises.contains(2));
  EXPECT_EQ(iris_.moves[2], 0);
  EXPECT_NE(record_.light[1].state, LightState::iris_fault);
  EXPECT_FALSE(record_.unhealthy_irises.contains(1));
  EXPECT_EQ(iris_.moves[1], 1);
}

TEST_F(LitCycleTest, FarewellGivesTheIrisesBack) {
  drive(2, 0.9);
  EXPECT_FALSE(record_.light[0].automatic);
  EXPECT_EQ(iris_.released, CameraSet{});
  lit_->farewell(clock_.now());
  EXPECT_EQ(iris_.released, CameraSet::first(kCameras));
}

TEST_F(LitCycleTest, SwitchedOffItOrdersNothing) {
  exposure::LightSettings off = settings();
  off.on = false;
  exposure::LightControl idle(scene_.rig(), off);
  lit_.emplace(CycleParts{.grabber = grabber_,
                          .iris = iris_,
                          .can = can_,
                          .tracker = tracker_,
                          .clock = clock_,
                          .stopwatch = stopwatch_,
                          .records = *ring_,
                          .light = &idle},
               settings_for(scene_.rig(), kPeriod));
  drive(3, 0.6);
  EXPECT_FALSE(grabber_.exposures[0]);
  EXPECT_EQ(iris_.moves[0], 0);
  EXPECT_EQ(record_.light[0].state, LightState::off);
  EXPECT_GT(record_.light[0].peak_dn, 0);
}

}  // namespace
}  // namespace dottrack::cycle::test
