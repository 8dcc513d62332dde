// The loop that sets its cameras' light.

#include <gtest/gtest.h>

#include <algorithm>
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
    make(light_);
  }

  void make(exposure::LightControl& light, const protocol::BroadcastSettings& broadcast = {}) {
    lit_.emplace(CycleParts{.grabber = grabber_,
                            .iris = iris_,
                            .can = can_,
                            .tracker = tracker_,
                            .clock = clock_,
                            .stopwatch = stopwatch_,
                            .records = *ring_,
                            .light = &light},
                 settings_for(scene_.rig(), kPeriod, broadcast));
  }

  std::size_t lights_sent() const {
    constexpr std::uint32_t kLight = protocol::kDefaultBaseId + 19;
    return static_cast<std::size_t>(std::count_if(
        can_.sent.begin(), can_.sent.begin() + static_cast<std::ptrdiff_t>(can_.sent_size),
        [](const hal::CanFrame& frame) { return frame.id == kLight; }));
  }

  const telemetry::CycleRecord& lit_tick() {
    lit_->tick(timer_.wait());
    if (!ring_->try_pop(record_)) throw std::runtime_error("the tick left no record");
    return record_;
  }

  // The drive's next ticks, every dot as bright as share of how it is drawn.
  void drive(std::uint64_t ticks, double share) {
    for (const std::uint64_t end = driven_ + ticks; driven_ < end; ++driven_) {
      const std::uint64_t n = driven_;
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
  std::uint64_t driven_ = 0;  // ticks
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

// One camera a group, one after another, as it stood in the tick before.
TEST_F(LitCycleTest, TheBusIsToldOfOneCameraAGroup) {
  protocol::BroadcastSettings broadcast;
  broadcast.rates.light_every = 1;
  make(light_, broadcast);
  iris_.broken.insert(2);
  drive(1, 0.6);
  const BusListener first = listen();
  EXPECT_TRUE(first.light(0).known);
  EXPECT_STREQ(dottrack_light_text(first.light(0).state), "off") << "nothing decided yet";
  EXPECT_LT(first.light(0).exposure_s, 0.0);
  EXPECT_FALSE(first.light(1).known);
  drive(7, 0.6);
  const BusListener listener = listen();
  EXPECT_EQ(listener.counts().corrupted + listener.counts().incomplete, 0U);
  ASSERT_TRUE(listener.light(1).known && listener.light(2).known && listener.light(3).known);
  EXPECT_FALSE(listener.light(kCameras).known) << "no camera of the rig";
  EXPECT_GT(listener.light(1).exposure_s, 0.002) << "dark dots";
  EXPECT_GE(listener.light(1).gain, 1.0);
  EXPECT_NEAR(listener.light(1).opening, FakeIris::kAutomatic, 0.1);
  EXPECT_STREQ(dottrack_light_text(listener.light(2).state), "iris_fault");
  EXPECT_STREQ(dottrack_iris_text(listener.light(2).iris), "fault");
  EXPECT_STREQ(dottrack_iris_text(listener.light(3).iris), "ok");
  EXPECT_EQ(lights_sent(), 8U);
}

TEST(LightWords, AreTheReceivers) {
  for (std::uint8_t number = 0; number < 255; ++number) {
    EXPECT_EQ(to_string(static_cast<LightState>(number)), dottrack_light_text(number));
    EXPECT_EQ(to_string(static_cast<exposure::IrisCondition>(number)), dottrack_iris_text(number));
  }
}

TEST_F(LitCycleTest, TheBusIsToldNothingOfTheLightUnlessAsked) {
  drive(3, 0.6);
  EXPECT_EQ(lights_sent(), 0U);
}

TEST_F(LitCycleTest, ALightThatDoesNotGoOutIsToldNextTime) {
  protocol::BroadcastSettings broadcast;
  broadcast.rates.light_every = 1;
  make(light_, broadcast);
  drive(1, 0.9);
  const std::size_t before = can_.sent_size;
  can_.answer = hal::SendResult::try_again;
  can_.answer_from = can_.attempts + 13;  // the group of the next tick, but not its light
  drive(1, 0.9);
  EXPECT_EQ(can_.sent_size, before + 13);
  EXPECT_FALSE(listen().light(1).known);
  EXPECT_EQ(record_.counters.sends_without_room, 1U);
  can_.answer = hal::SendResult::accepted;
  drive(1, 0.9);
  EXPECT_TRUE(listen().light(1).known);
  EXPECT_FALSE(listen().light(2).known);
}

TEST_F(LitCycleTest, FarewellGivesTheIrisesBack) {
  drive(2, 0.9);
  EXPECT_NE(record_.light[0].iris, exposure::IrisCondition::automatic);
  EXPECT_EQ(iris_.released, CameraSet{});
  lit_->farewell(clock_.now());
  EXPECT_EQ(iris_.released, CameraSet::first(kCameras));
}

TEST_F(LitCycleTest, SwitchedOffItOrdersNothing) {
  exposure::LightSettings off = settings();
  off.on = false;
  exposure::LightControl idle(scene_.rig(), off);
  make(idle);
  drive(3, 0.6);
  EXPECT_FALSE(grabber_.exposures[0]);
  EXPECT_EQ(iris_.moves[0], 0);
  EXPECT_EQ(record_.light[0].state, LightState::off);
  EXPECT_GT(record_.light[0].peak_dn, 0);
}

}  // namespace
}  // namespace dottrack::cycle::test
