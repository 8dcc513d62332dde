#include "app/cycle/cycle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtos_shim/allocation_trap/allocation_trap.h"
#include "tests/unit/cycle/cycle_fixture.h"

namespace dottrack::cycle::test {
namespace {

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
}  // namespace dottrack::cycle::test
