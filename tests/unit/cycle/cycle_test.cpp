#include "app/cycle/cycle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "rtos_shim/allocation_trap/allocation_trap.h"
#include "rtos_shim/virtual_time/virtual_clock.h"
#include "rtos_shim/virtual_time/virtual_periodic_timer.h"
#include "tests/support/bus_listener.h"
#include "tests/support/disc_scene.h"
#include "tests/unit/cycle/fake_hardware.h"

namespace dottrack::cycle {
namespace {

using dottrack::test::BusListener;
using dottrack::test::DiscScene;
using dottrack::test::GreyImage;
using std::chrono::milliseconds;

constexpr Duration kPeriod = milliseconds(20);
constexpr std::size_t kCameras = 4;

// Ticks a millisecond each time it is read.
class Stopwatch final : public rtos::Clock {
 private:
  Time do_now() const override { return Time(milliseconds(++reads_)); }
  mutable int reads_ = 0;
};

class CycleTest : public testing::Test {
 protected:
  void show(std::uint64_t tick) {
    for (std::size_t i = 0; i < kCameras; ++i) {
      shown_[i] = scene_.image_at(i, tick);
      grabber_.images[i] = shown_[i].view();
    }
  }

  const telemetry::CycleRecord& tick() {
    cycle_.tick(timer_.wait());
    if (!ring_->try_pop(record_)) throw std::runtime_error("the tick left no record");
    return record_;
  }

  // All that went out, as a vehicle hears it.
  BusListener listen() {
    BusListener listener;
    for (std::size_t i = 0; i < can_.sent_size; ++i) listener.hear(can_.sent[i]);
    return listener;
  }

  std::optional<dottrack_pose> last_message() {
    const BusListener listener = listen();
    return listener.poses().empty() ? std::nullopt : std::optional(listener.poses().back());
  }

  DiscScene scene_;
  std::array<GreyImage, kCameras> shown_;
  test::FakeGrabber grabber_;
  test::FakeIris iris_;
  test::FakeCan can_;
  core::Tracker tracker_{scene_.rig()};
  rtos::VirtualClock clock_;
  rtos::VirtualPeriodicTimer timer_{clock_, Time(milliseconds(100)), kPeriod};
  Stopwatch stopwatch_;
  std::unique_ptr<telemetry::RecordRing> ring_ = std::make_unique<telemetry::RecordRing>();
  Cycle cycle_{{grabber_, iris_, can_, tracker_, clock_, stopwatch_, *ring_},
               settings_for(scene_.rig(), kPeriod)};
  telemetry::CycleRecord record_;
};

TEST_F(CycleTest, FramesBecomeAPoseOnTheBus) {
  show(0);
  grabber_.lag = milliseconds(3);
  const telemetry::CycleRecord& record = tick();
  ASSERT_TRUE(record.result.has_pose) << core::to_string(record.result.reason);
  const core::Pose truth = DiscScene::pose_at(0);
  EXPECT_LT((record.result.pose.position_m - truth.position_m).norm(), 0.005);
  EXPECT_LT(record.result.pose.orientation.angularDistance(truth.orientation), 0.01);

  const auto message = last_message();
  ASSERT_TRUE(message);
  EXPECT_TRUE(message->valid);
  EXPECT_EQ(message->state, DOTTRACK_TRACKING);
  EXPECT_EQ(message->capture_us, 103'000U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(message->position_m[i], record.result.pose.position_m[i], 1e-4);
  }
  EXPECT_EQ(message->cameras_used, record.result.cameras_used.bits());
  EXPECT_TRUE(message->has_covariance);
  EXPECT_LE(message->false_lock_probability, 0.01);
  EXPECT_GE(message->false_lock_probability, record.result.false_lock_probability);
  EXPECT_EQ(record.counters.messages_sent, 1U);
}

TEST_F(CycleTest, FollowsADriveTickByTick) {
  for (std::uint64_t n = 0; n < 10; ++n) {
    show(n);
    const telemetry::CycleRecord& record = tick();
    ASSERT_TRUE(record.result.has_pose) << "tick " << n;
    EXPECT_EQ(record.result.tick, n);
    EXPECT_LT((record.result.pose.position_m - DiscScene::pose_at(n).position_m).norm(), 0.005);
  }
  EXPECT_EQ(record_.result.reset_count, 1U);
}

TEST_F(CycleTest, DeadlinesCountFromTheInstantOfTheGrid) {
  tick();
  EXPECT_EQ(grabber_.expected, CameraSet::first(kCameras));
  EXPECT_EQ(grabber_.deadline, Time(milliseconds(110)));
  EXPECT_EQ(can_.deadline, Time(milliseconds(120)));
}

TEST_F(CycleTest, BuffersGoBackOnceATick) {
  tick();
  tick();
  EXPECT_EQ(grabber_.triggers, 2);
  EXPECT_EQ(grabber_.releases, 2);
}

TEST_F(CycleTest, ACameraThatDoesNotDeliverIsLeftOutAndCounted) {
  show(0);
  grabber_.images[2] = {};
  const telemetry::CycleRecord& record = tick();
  EXPECT_TRUE(record.result.has_pose);
  EXPECT_FALSE(record.result.cameras_used.contains(2));
  EXPECT_EQ(record.counters.missing_frames[2], 1U);
  EXPECT_EQ(record.counters.missing_frames[0], 0U);
}

TEST_F(CycleTest, AnImageOfTheWrongSizeCountsAsNotDelivered) {
  show(0);
  const GreyImage small = dottrack::test::flat_image(64, 48, 100);
  grabber_.images[1] = small.view();
  const telemetry::CycleRecord& record = tick();
  EXPECT_TRUE(record.result.has_pose);
  EXPECT_EQ(record.counters.missing_frames[1], 1U);
}

TEST_F(CycleTest, WithoutFramesTheBusHearsThatThereIsNoPose) {
  show(0);
  tick();
  grabber_.images.fill({});
  const telemetry::CycleRecord& record = tick();
  EXPECT_FALSE(record.result.has_pose);
  EXPECT_EQ(record.result.reason, core::Reason::no_frames);
  EXPECT_EQ(record.stamp, Time(milliseconds(120)));
  const auto message = last_message();
  ASSERT_TRUE(message);
  EXPECT_FALSE(message->valid);
  EXPECT_STREQ(dottrack_reason_text(message->reason), "no_frames");
  EXPECT_EQ(message->capture_us, 120'000U);
}

TEST_F(CycleTest, AFullBusIsCountedAndTheRestOfTheGroupStaysAtHome) {
  can_.answer = hal::SendResult::try_again;
  can_.answer_from = 2;
  const telemetry::CycleRecord& record = tick();
  EXPECT_EQ(can_.attempts, 3U);
  EXPECT_EQ(record.counters.sends_without_room, 1U);
  EXPECT_EQ(record.counters.messages_sent, 0U);
  EXPECT_FALSE(last_message());
}

TEST_F(CycleTest, ADeadBusIsCountedAndTheLoopGoesOn) {
  can_.answer = hal::SendResult::failed;
  show(0);
  tick();
  show(1);
  const telemetry::CycleRecord& record = tick();
  EXPECT_TRUE(record.result.has_pose);
  EXPECT_EQ(record.counters.sends_failed, 2U);
}

TEST_F(CycleTest, MissedInstantsAreCounted) {
  tick();
  clock_.jump_to(Time(milliseconds(150)));  // over 120 and 140
  EXPECT_EQ(tick().counters.deadline_misses, 2U);
  EXPECT_EQ(record_.due, Time(milliseconds(160)));
}

TEST_F(CycleTest, IrisesThatDoNotAnswerAreNoted) {
  iris_.broken.insert(3);
  EXPECT_EQ(tick().unhealthy_irises.bits(), 0b1000);
}

TEST_F(CycleTest, EveryStageIsTimedAndRecordingOneTickLater) {
  EXPECT_EQ(tick().stages.record, Duration(0));
  const telemetry::StageTimes& took = tick().stages;
  for (const Duration stage :
       {took.capture, took.track, took.broadcast, took.expose, took.record}) {
    EXPECT_EQ(stage, milliseconds(1));
  }
}

TEST_F(CycleTest, ARecorderThatIsTooSlowLosesRecordsAndNotTheLoop) {
  for (std::size_t n = 0; n < telemetry::RecordRing::capacity() + 3; ++n)
    cycle_.tick(timer_.wait());
  telemetry::CycleRecord record;
  while (ring_->try_pop(record)) continue;
  EXPECT_EQ(record.result.tick, telemetry::RecordRing::capacity() - 1);
  EXPECT_EQ(tick().counters.records_dropped, 3U);
}

TEST_F(CycleTest, TheFarewellLeavesASafeStateAndSaysWhy) {
  show(0);
  tick();
  clock_.jump_to(Time(milliseconds(115)));
  cycle_.farewell(clock_.now());
  EXPECT_EQ(iris_.released, CameraSet::first(kCameras));
  const auto message = last_message();
  ASSERT_TRUE(message);
  EXPECT_FALSE(message->valid);
  EXPECT_EQ(message->state, DOTTRACK_ACQUIRING);
  EXPECT_STREQ(dottrack_reason_text(message->reason), "stopped");
  EXPECT_EQ(message->reset_count, 1);
}

TEST_F(CycleTest, AnotherTrackerTakesOverAndItsLocksCountOn) {
  show(0);
  tick();
  core::Tracker other(scene_.rig());
  cycle_.use(other, scene_.rig().target.dots.size(), {});
  show(1);
  const telemetry::CycleRecord& record = tick();
  EXPECT_TRUE(record.result.has_pose);
  EXPECT_EQ(record.result.tick, 1U);
  EXPECT_EQ(record.result.reset_count, 2U);
}

TEST_F(CycleTest, AVehicleHearsHowItMoves) {
  for (std::uint64_t n = 0; n < 2; ++n) {
    show(n);
    tick();
  }
  const auto message = last_message();
  ASSERT_TRUE(message);
  ASSERT_TRUE(message->has_velocity);
  ASSERT_TRUE(message->has_rates);
  const Eigen::Vector3d driven =
      DiscScene::pose_at(1).position_m - DiscScene::pose_at(0).position_m;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(message->velocity_m_s[i], driven[i] / 0.02, 0.2);
}

TEST_F(CycleTest, EveryGroupOfARunIsWholeAndItsSequenceCounts) {
  for (std::uint64_t n = 0; n < 12; ++n) {
    show(n);
    tick();
  }
  const BusListener listener = listen();
  ASSERT_EQ(listener.poses().size(), 12U);
  for (std::size_t n = 0; n < 12; ++n) EXPECT_EQ(listener.poses()[n].sequence, n);
  EXPECT_EQ(listener.counts().incomplete + listener.counts().corrupted, 0U);
  EXPECT_EQ(listener.poses()[0].dots, scene_.rig().target.dots.size());
  EXPECT_EQ(listener.poses()[1].dots, 0) << "dots are told every tenth time";
  EXPECT_EQ(listener.poses()[10].dots, scene_.rig().target.dots.size());
  EXPECT_TRUE(listener.unit().has_version);
}

class CommandedCycleTest : public CycleTest {
 protected:
  CommandedCycleTest() {
    protocol::BroadcastSettings broadcast;
    broadcast.commands = true;
    broadcast.targets = 2;
    commanded_.emplace(CycleParts{.grabber = grabber_,
                                  .iris = iris_,
                                  .can = can_,
                                  .tracker = tracker_,
                                  .clock = clock_,
                                  .stopwatch = stopwatch_,
                                  .records = *ring_,
                                  .requests = &requests_},
                       settings_for(scene_.rig(), kPeriod, broadcast));
  }

  void hear(protocol::CommandCode code, std::uint8_t argument = 0) {
    can_.heard.push_back(
        protocol::encode_command({code, argument, kToken}, {}, command_sequence_++));
  }

  const telemetry::CycleRecord& commanded_tick() {
    commanded_->tick(timer_.wait());
    if (!ring_->try_pop(record_)) throw std::runtime_error("the tick left no record");
    return record_;
  }

  std::vector<dottrack_reply> replies() const {
    std::vector<dottrack_reply> replies;
    const dottrack_settings settings = dottrack_default_settings();
    for (std::size_t i = 0; i < can_.sent_size; ++i) {
      dottrack_reply reply{};
      const dottrack_frame frame = dottrack::test::receiver_frame(can_.sent[i]);
      if (dottrack_read_reply(&settings, &frame, &reply)) replies.push_back(reply);
    }
    return replies;
  }

  static constexpr std::uint16_t kToken = 0xBEEF;
  Requests requests_;
  std::optional<Cycle> commanded_;
  std::uint8_t command_sequence_ = 7;
};

TEST_F(CommandedCycleTest, ACommandMakesItLookForTheTargetAnew) {
  show(0);
  commanded_tick();
  hear(protocol::CommandCode::acquire);
  EXPECT_EQ(commanded_tick().result.reset_count, 1U);
  EXPECT_EQ(record_.counters.commands.accepted, 1U);
  show(1);
  EXPECT_EQ(commanded_tick().result.reset_count, 2U);
  ASSERT_EQ(replies().size(), 1U);
  EXPECT_EQ(replies()[0].token, kToken);
  EXPECT_STREQ(dottrack_result_text(replies()[0].result), "done");
}

TEST_F(CommandedCycleTest, AnotherTargetIsAskedForOnce) {
  hear(protocol::CommandCode::set_target, 1);
  commanded_tick();
  EXPECT_TRUE(requests_.pending());
  EXPECT_EQ(requests_.take_target(), 1);
  EXPECT_EQ(requests_.take_target(), std::nullopt);
}

TEST_F(CommandedCycleTest, ATargetThatTheRigDoesNotHaveIsRefused) {
  hear(protocol::CommandCode::set_target, 2);
  const telemetry::CycleRecord& record = commanded_tick();
  EXPECT_FALSE(requests_.pending());
  EXPECT_EQ(record.counters.commands.rejected, 1U);
  ASSERT_EQ(replies().size(), 1U);
  EXPECT_STREQ(dottrack_result_text(replies()[0].result), "bad_argument");
}

TEST_F(CommandedCycleTest, TheVersionIsReportedAtOnce) {
  commanded_tick();
  commanded_tick();
  can_.sent_size = 0;
  hear(protocol::CommandCode::report_version);
  commanded_tick();  // is told after its group
  commanded_tick();
  const BusListener listener = listen();
  EXPECT_TRUE(listener.unit().has_version);
  EXPECT_TRUE(listener.unit().has_configuration);
}

TEST_F(CommandedCycleTest, AFloodOfCommandsIsHeardALittleATick) {
  for (int i = 0; i < 100; ++i) hear(protocol::CommandCode::acquire);
  commanded_tick();
  EXPECT_EQ(record_.counters.commands.accepted, 1U);
  EXPECT_GE(can_.heard.size(), 90U);
  commanded_tick();
  EXPECT_EQ(record_.counters.commands.accepted, 1U);
  EXPECT_GT(record_.counters.commands.rejected, 0U) << "too soon";
}

TEST_F(CycleTest, CommandsAreNotHeardUnlessAskedFor) {
  can_.heard.push_back(protocol::encode_command({}, {}, 1));
  tick();
  EXPECT_EQ(can_.heard.size(), 1U);
  EXPECT_EQ(record_.counters.commands.accepted, 0U);
}

class UnitCycleTest : public CycleTest {
 protected:
  static std::vector<telemetry::FrameSize> sizes(const core::Rig& rig) {
    std::vector<telemetry::FrameSize> sizes;
    for (const core::Camera& camera : rig.cameras) {
      sizes.push_back({camera.width_px, camera.height_px});
    }
    return sizes;
  }

  test::FakeLine lamp_;
  test::FakeWatchdog watchdog_;
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

TEST_F(CycleTest, NoTickTouchesTheHeap) {
  std::uint64_t heap_calls = 0;
  const auto armed_tick = [&] {
    const rtos::Wake wake = timer_.wait();
    const rtos::AllocationTrap::Scope armed;
    cycle_.tick(wake);
    heap_calls += armed.calls().total();
  };
  for (std::uint64_t n = 0; n < 5; ++n) {  // acquires, then follows
    show(n);
    armed_tick();
  }
  const GreyImage noise = dottrack::test::noise_image(400, 300, 1);
  const GreyImage white = dottrack::test::flat_image(400, 300, 255);
  for (const ImageView& image : {noise.view(), white.view(), ImageView{}}) {  // loses, searches
    grabber_.images.fill(image);
    for (int n = 0; n < 8; ++n) armed_tick();
  }
  EXPECT_EQ(heap_calls, 0U);
}

}  // namespace
}  // namespace dottrack::cycle
