#pragma once
// A record with every kind of content.

#include "app/telemetry/cycle_record.h"

namespace dottrack::telemetry {

inline CycleRecord record_with_pose(std::uint64_t tick) {
  CycleRecord record;
  record.due = record.stamp = Time(Duration(1500000000 + static_cast<Duration::rep>(tick)));
  core::TickResult& result = record.result;
  result.tick = tick;
  result.state = core::State::tracking;
  result.reason = core::Reason::none;
  result.has_pose = true;
  result.pose.position_m = {1.25, -0.5, 0.1};
  result.pose.orientation = Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5);
  for (int i = 0; i < 36; ++i) result.pose.covariance(i / 6, i % 6) = 1e-6 * (i + 1);
  result.pose.rms_residual_m = 0.003;
  result.dot_sigma_m = 0.0002;
  result.reset_count = 1;
  result.dots_used = 2;
  result.cameras_used = CameraSet(0b11);
  result.dots[0].located = true;
  result.dots[0].position_m = {0.1, 0.2, 0.3};
  result.dots[0].position_sigma_m = 0.004;
  result.dots[0].views[1].used = true;
  result.dots[0].views[1].pixel = {12.5F, 99.25F};
  result.dots[0].views[1].residual_px = 0.125F;
  core::CameraTick& left = result.cameras[0];
  left.delivered = left.used = true;
  left.components = 19;
  left.rejected_size = 8;
  left.rejected_shape = 4;
  left.regions = 7;
  left.rejected_sight = 2;
  left.sightings = 5;
  result.cameras[1].overflow = true;
  exposure::CameraLight& light = record.light[0];
  light.state = exposure::LightState::steady;
  light.iris = exposure::IrisCondition::at_end;
  light.setting = {std::chrono::microseconds(2500), 1.5};
  light.opening = 0.75;
  light.peak_dn = 180;
  result.relock = core::Relock::better_elsewhere;
  result.acquisition.pairs_tested = 1234;
  result.acquisition.ticks = 2;
  result.acquisition.min_views = 3;
  result.acquisition.dots_matched = 4;
  result.acquisition.false_lock_probability = 0.25;
  result.false_lock_probability = 0.125;
  result.filtered.motion = {true, {0.5, -0.25, 0.0}, {0.0, 0.0, 1.5}};
  return record;
}

inline CycleRecord record_without_pose(std::uint64_t tick) {
  CycleRecord record;
  record.stamp = Time(Duration(7));
  record.result.tick = tick;
  record.result.reason = core::Reason::too_few_regions;
  record.result.ticks_lost = 3;
  return record;
}

}  // namespace dottrack::telemetry
