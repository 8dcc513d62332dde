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

protocol::PoseMessage report(const telemetry::CycleRecord& record) {
  return pose_report(record, kRig, {}, Time(milliseconds(1025)));
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
  record.result.motion.known = true;
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
  EXPECT_TRUE(pose_report(record, kRig, record.counters, record.stamp).degraded.empty())
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

}  // namespace
}  // namespace dottrack::cycle
