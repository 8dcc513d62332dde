#include "app/cycle/pose_report.h"

namespace dottrack::cycle {
namespace {

using core::TickResult;
using protocol::CameraHealth;
using protocol::Degraded;
using protocol::DegradedSet;
using protocol::PoseKind;
using protocol::Visibility;
using telemetry::CycleCounters;
using telemetry::CycleRecord;

protocol::DotReport dot_report(const core::DotState& dot) {
  protocol::DotReport report;
  report.cameras = dot.cameras;
  if (dot.cameras.empty()) return report;
  report.visibility = dot.located ? Visibility::located : Visibility::one_camera;
  report.position_m = dot.position_m;
  report.sigma_m = dot.position_sigma_m;
  return report;
}

CameraHealth camera_health(const core::CameraTick& camera, bool iris_fault) {
  if (camera.stale) return CameraHealth::stale;
  if (!camera.delivered) return CameraHealth::no_frame;
  if (camera.moved) return CameraHealth::moved;
  if (iris_fault) return CameraHealth::iris_fault;
  if (camera.overflow) return CameraHealth::overflow;
  return camera.used ? CameraHealth::used : CameraHealth::unused;
}

void judge_cameras(const CycleRecord& record, std::size_t cameras, DegradedSet& degraded) {
  for (std::size_t i = 0; i < cameras; ++i) {
    const core::CameraTick& camera = record.result.cameras[i];
    degraded.insert_if(camera.stale, Degraded::camera_stale);
    degraded.insert_if(!camera.delivered && !camera.stale, Degraded::camera_missing);
    degraded.insert_if(camera.overflow, Degraded::camera_overflow);
    degraded.insert_if(camera.moved, Degraded::camera_moved);
  }
  degraded.insert_if(record.result.rig_disagrees, Degraded::rig_disagrees);
  degraded.insert_if(!record.unhealthy_irises.empty(), Degraded::iris_fault);
}

void judge_pose(const TickResult& result, std::size_t dots, DegradedSet& degraded) {
  if (!result.has_pose) return;
  degraded.insert_if(result.dots_used < dots, Degraded::dots_missing);
  degraded.insert_if(result.cameras_used.size() < 3, Degraded::few_cameras);
  for (std::size_t i = 0; i < dots; ++i) {
    const core::DotState& dot = result.dots[i];
    degraded.insert_if(!dot.located && !dot.cameras.empty(), Degraded::single_view_dots);
  }
}

void judge_loop(const CycleRecord& record, const CycleCounters& before, DegradedSet& degraded) {
  const CycleCounters& now = record.counters;
  degraded.insert_if(now.deadline_misses > before.deadline_misses, Degraded::tick_missed);
  degraded.insert_if(
      now.sends_failed + now.sends_without_room > before.sends_failed + before.sends_without_room,
      Degraded::message_lost);
  degraded.insert_if(now.records_dropped > before.records_dropped, Degraded::record_lost);
  degraded.insert_if(record.can_state != hal::CanState::active, Degraded::bus_trouble);
}

void report_pose(const TickResult& result, const SentPose& sent, protocol::PoseMessage& message) {
  message.kind = sent.kind;
  message.pose_valid = sent.valid;
  if (!sent.valid) return;
  message.position_m = sent.pose.position_m;
  message.orientation = sent.pose.orientation;
  message.covariance = sent.pose.covariance;
  message.residual_m = result.pose.rms_residual_m;
  message.false_lock_probability = result.false_lock_probability;
  if (!result.filtered.motion.known) return;
  message.velocity_m_s = result.filtered.motion.velocity_m_s;
  message.rates_rad_s = result.filtered.motion.rates_rad_s;
}

}  // namespace

SentPose chosen_pose(const CycleRecord& record, protocol::PoseChoice choice,
                     const core::FilteredPose& predicted, Time now) {
  const TickResult& result = record.result;
  if (choice == protocol::PoseChoice::measured || !result.filtered.known) {
    return {PoseKind::measured, result.has_pose, result.pose, record.stamp};
  }
  const bool ahead = choice == protocol::PoseChoice::predicted && predicted.known;
  const core::FilteredPose& pose = ahead ? predicted : result.filtered;
  const PoseKind kind = result.filtered.coasting ? PoseKind::coasting
                        : ahead                  ? PoseKind::predicted
                                                 : PoseKind::filtered;
  return {kind, true, pose.pose, ahead ? now : record.stamp};
}

protocol::PoseMessage pose_report(const CycleRecord& record, const SentPose& sent,
                                  const RigSize& rig, const CycleCounters& before, Time now) {
  const TickResult& result = record.result;
  protocol::PoseMessage message;
  message.state = result.state;
  message.reason = result.reason;
  message.cameras_used = result.cameras_used;
  message.dots_used = result.dots_used;
  message.reset_count = static_cast<std::uint8_t>(result.reset_count);
  message.mid_exposure = sent.at;
  message.age = now - sent.at;
  report_pose(result, sent, message);
  message.dots_known = static_cast<std::uint8_t>(rig.dots);
  for (std::size_t i = 0; i < rig.dots; ++i) message.dots[i] = dot_report(result.dots[i]);
  for (std::size_t i = 0; i < rig.cameras; ++i) {
    message.cameras[i] = camera_health(result.cameras[i], record.unhealthy_irises.contains(i));
  }
  judge_cameras(record, rig.cameras, message.degraded);
  judge_pose(result, rig.dots, message.degraded);
  judge_loop(record, before, message.degraded);
  return message;
}

}  // namespace dottrack::cycle
