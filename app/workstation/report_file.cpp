#include "app/workstation/report_file.h"

#include <fmt/format.h>

#include "app/workstation/json_object.h"

namespace dottrack::workstation {
namespace {

std::string missing_frames(const config::RigConfig& rig, const telemetry::CycleCounters& counters) {
  JsonObject object(1);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    object.add(rig.cameras[i].name, counters.missing_frames[i]);
  }
  return object.text();
}

std::string reasons(const RunTally& tally) {
  JsonObject object(1);
  for (const auto& [reason, ticks] : tally.reasons()) object.add(reason, ticks);
  return object.text();
}

std::string last_lock(const RunTally& tally) {
  if (!tally.last_lock()) return "null";
  const core::TickResult& lock = *tally.last_lock();
  const Eigen::Vector3d& p = lock.pose.position_m;
  const Eigen::Quaterniond& q = lock.pose.orientation;
  JsonObject object(1);
  object.add("tick", lock.tick);
  object.add("position_m", fmt::format("[{}, {}, {}]", p.x(), p.y(), p.z()));
  object.add("quaternion_xyzw", fmt::format("[{}, {}, {}, {}]", q.x(), q.y(), q.z(), q.w()));
  object.add("rms_residual_m", lock.pose.rms_residual_m);
  object.add("dots_used", lock.dots_used);
  object.add("cameras_used", lock.cameras_used.size());
  return object.text();
}

std::string memory(const RunFacts& facts) {
  JsonObject object(1);
  object.add("tracker", facts.tracker_bytes);
  object.add("record_ring", sizeof(telemetry::RecordRing));
  return object.text();
}

std::string times(const TimeFigures& figures) {
  return fmt::format("{{\"p50\": {:.3f}, \"p99\": {:.3f}, \"max\": {:.3f}}}", figures.p50_us,
                     figures.p99_us, figures.max_us);
}

}  // namespace

std::string report_json(const config::RigConfig& rig, const RunTally& tally,
                        const RunFacts& facts) {
  const telemetry::CycleCounters& counters = tally.last_record().counters;
  JsonObject report(0);
  report.add("rig", json_string(rig.name));
  report.add("target", json_string(rig.target_name));
  report.add("build_type", json_string(DOTTRACK_BUILD_TYPE));
  report.add("frame_rate_hz", rig.frame_rate_hz);
  report.add("ticks", tally.ticks());
  report.add("tracking_ticks", tally.tracking_ticks());
  report.add("first_lock_tick", tally.first_lock_tick());
  report.add("reacquisitions", tally.reacquisitions());
  report.add("deadline_misses", counters.deadline_misses);
  report.add("allocations_in_loop", facts.allocations_in_loop);
  report.add("allocation_trap_complete", facts.allocation_trap_complete);
  report.add("bad_frames", facts.bad_frames);
  report.add("missing_frames", missing_frames(rig, counters));
  report.add("reasons", reasons(tally));
  report.add("messages_sent", counters.messages_sent);
  report.add("sends_without_room", counters.sends_without_room);
  report.add("sends_failed", counters.sends_failed);
  report.add("records_dropped", counters.records_dropped);
  report.add("mean_rms_residual_m", tally.mean_rms_residual_m());
  report.add("last_lock", last_lock(tally));
  report.add("memory_bytes", memory(facts));
  for (const auto& [name, figures] : tally.times()) report.add(name + "_us", times(figures));
  for (const auto& [key, value] : facts.more) report.add(key, value);
  return report.text() + "\n";
}

}  // namespace dottrack::workstation
