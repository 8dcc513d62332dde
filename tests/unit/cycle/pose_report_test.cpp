#include "app/cycle/pose_report.h"

#include <gtest/gtest.h>

namespace dottrack::cycle {
namespace {

using protocol::CameraHealth;
using protocol::Degraded;
using protocol::Visibility;
using std::chrono::milliseconds;

constexpr RigSize kRig{3, 4};

// Everything as it should be: three cameras, four dots, a lock.
telemetry::CycleRecord good_tick() {
  telemetry::CycleRecord record;
  record.stamp = Time(milliseconds(1000));
  core::TickResult& result = record.result;
  result.state = core::State::tracking;
  result.reason = core::Reason::none;
  result.has_pose = true;
  result.cameras_used = CameraSet::first(3);
  result.dots_used = 4;
  for (std::size_t i = 0; i < 3; ++i) {
    result.cameras[i].delivered = true;
    result.cameras[i].used = true;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    result.dots[i].located = true;
    result.dots[i].cameras = CameraSet::first(3);
    result.dots[i].position_m.x() = static_cast<double>(i);
  }
  return record;
}

SentPose measured(const telemetry::CycleRecord& record) {
  return chosen_pose(record, protocol::PoseChoice::measured, {}, record.stamp);
}

protocol::PoseMessage report(const telemetry::CycleRecord& record) {
  return pose_report(record, measured(record), kRig, {}, Time(milliseconds(1025)));
}

// The one reason for which a report is degraded.
void expect_only(const telemetry::CycleRecord& record, Degraded reason) {
  protocol::DegradedSet only;
  only.insert(reason);
  EXPECT_EQ(report(record).degraded.bits(), only.bits())
      << static_cast<unsigned>(reason) << " expected alone";
}

TEST(PoseReport, OfAGoodTickHasNoReasonToBeDegraded) {
  const protocol::PoseMessage message = report(good_tick());
  EXPECT_TRUE(message.pose_valid);
  EXPECT_TRUE(message.degraded.empty());
  EXPECT_EQ(message.age, milliseconds(25));
  EXPECT_EQ(message.dots_known, 4);
  EXPECT_EQ(message.dots[3].visibility, Visibility::located);
  EXPECT_EQ(message.dots[3].position_m.x(), 3.0);
  EXPECT_EQ(message.cameras[2], CameraHealth::used);
  EXPECT_EQ(message.cameras[3], CameraHealth::absent);
  EXPECT_FALSE(message.velocity_m_s) << "the first tick of a lock";
}

TEST(PoseReport, WithoutAPoseHasNothingThatDescribesOne) {
  telemetry::CycleRecord record = good_tick();
  record.result.has_pose = false;
  record.result.reason = core::Reason::residual;
  record.result.filtered.motion.known = true;
  const protocol::PoseMessage message = report(record);
  EXPECT_FALSE(message.pose_valid);
  EXPECT_FALSE(message.covariance);
  EXPECT_FALSE(message.velocity_m_s);
  EXPECT_EQ(message.false_lock_probability, 1.0);
}

TEST(PoseReport, EveryReasonOfACameraIsTold) {
  telemetry::CycleRecord record = good_tick();
  record.result.cameras[1].delivered = false;
  expect_only(record, Degraded::camera_missing);
  EXPECT_EQ(report(record).cameras[1], CameraHealth::no_frame);
  record.result.cameras[1].stale = true;
  expect_only(record, Degraded::camera_stale);
  EXPECT_EQ(report(record).cameras[1], CameraHealth::stale);
  record = good_tick();
  record.result.cameras[0].overflow = true;
  expect_only(record, Degraded::camera_overflow);
  EXPECT_EQ(report(record).cameras[0], CameraHealth::overflow);
  record = good_tick();
  record.unhealthy_irises.insert(2);
  expect_only(record, Degraded::iris_fault);
  EXPECT_EQ(report(record).cameras[2], CameraHealth::iris_fault);
  record = good_tick();
  record.result.cameras[1].moved = true;
  expect_only(record, Degraded::camera_moved);
  EXPECT_EQ(report(record).cameras[1], CameraHealth::moved);
  record = good_tick();
  record.result.rig_disagrees = true;
  expect_only(record, Degraded::rig_disagrees);
  record = good_tick();
  record.result.cameras[0].used = false;
  EXPECT_EQ(report(record).cameras[0], CameraHealth::unused);
}

TEST(PoseReport, EveryReasonOfAPoseIsTold) {
  telemetry::CycleRecord record = good_tick();
  record.result.dots_used = 3;
  expect_only(record, Degraded::dots_missing);
  record = good_tick();
  record.result.cameras_used = CameraSet::first(2);
  expect_only(record, Degraded::few_cameras);
  record = good_tick();
  record.result.dots[1].located = false;
  record.result.dots[1].cameras = CameraSet::first(1);
  expect_only(record, Degraded::single_view_dots);
  EXPECT_EQ(report(record).dots[1].visibility, Visibility::one_camera);
  record.result.dots[1].cameras = CameraSet{};
  EXPECT_EQ(report(record).dots[1].visibility, Visibility::not_seen);
}

TEST(PoseReport, EveryReasonOfTheLoopIsToldOnce) {
  telemetry::CycleRecord record = good_tick();
  record.counters.deadline_misses = 5;
  expect_only(record, Degraded::tick_missed);
  EXPECT_TRUE(
      pose_report(record, measured(record), kRig, record.counters, record.stamp).degraded.empty())
      << "the message before told of it";
  record = good_tick();
  record.counters.sends_failed = 1;
  expect_only(record, Degraded::message_lost);
  record = good_tick();
  record.counters.sends_without_room = 1;
  expect_only(record, Degraded::message_lost);
  record = good_tick();
  record.counters.records_dropped = 1;
  expect_only(record, Degraded::record_lost);
  record = good_tick();
  record.can_state = hal::CanState::passive;
  expect_only(record, Degraded::bus_trouble);
}

// The filter's pose a metre further on, and where it will be when the message goes out two.
TEST(PoseReport, TellsThePoseThatWasAskedForAndWhatItIs) {
  telemetry::CycleRecord record = good_tick();
  const Time now(milliseconds(1025));
  core::FilteredPose ahead;
  ahead.known = true;
  ahead.pose.position_m.x() = 2.0;
  const auto told = [&](protocol::PoseChoice choice) {
    return pose_report(record, chosen_pose(record, choice, ahead, now), kRig, {}, now);
  };
  using protocol::PoseChoice;
  using protocol::PoseKind;
  EXPECT_EQ(told(PoseChoice::filtered).kind, PoseKind::measured) << "the filter knows nothing yet";
  record.result.filtered.known = true;
  record.result.filtered.pose.position_m.x() = 1.0;
  EXPECT_EQ(told(PoseChoice::measured).kind, PoseKind::measured);
  EXPECT_EQ(told(PoseChoice::measured).position_m.x(), 0.0);
  EXPECT_EQ(told(PoseChoice::filtered).kind, PoseKind::filtered);
  EXPECT_EQ(told(PoseChoice::filtered).position_m.x(), 1.0);
  EXPECT_EQ(told(PoseChoice::filtered).mid_exposure, record.stamp);
  EXPECT_EQ(told(PoseChoice::predicted).kind, PoseKind::predicted);
  EXPECT_EQ(told(PoseChoice::predicted).position_m.x(), 2.0);
  EXPECT_EQ(told(PoseChoice::predicted).mid_exposure, now);
  EXPECT_EQ(told(PoseChoice::predicted).age, Duration{});

  record.result.has_pose = false;
  record.result.reason = core::Reason::too_few_dots;
  record.result.filtered.coasting = true;
  EXPECT_FALSE(told(PoseChoice::measured).pose_valid);
  for (const PoseChoice choice : {PoseChoice::filtered, PoseChoice::predicted}) {
    EXPECT_TRUE(told(choice).pose_valid);
    EXPECT_EQ(told(choice).kind, PoseKind::coasting);
    EXPECT_EQ(told(choice).reason, core::Reason::too_few_dots);
    EXPECT_EQ(told(choice).false_lock_probability, 1.0);
  }
}

}  // namespace
}  // namespace dottrack::cycle
