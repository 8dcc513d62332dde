#include "app/workstation/light_tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dottrack::workstation {
namespace {

constexpr int kSaturated_px = 2;  // of a camera's dots: a glint
constexpr double kTarget_dn = 191.0;
constexpr double kNearTarget = 1.3;  // as bright as it should be
constexpr double kHeld_s = 0.4;      // so long it has to stay so

bool near_target(int peak_dn) {
  return peak_dn < kNearTarget * kTarget_dn && peak_dn * kNearTarget > kTarget_dn;
}

}  // namespace

LightTally::LightTally(LightScript script) : script_(std::move(script)) {
  script_.changes_s.push_back(0.0);
  std::sort(script_.changes_s.begin(), script_.changes_s.end());
}

void LightTally::count_cameras(const telemetry::CycleRecord& record) {
  int judged = 0;
  int off = 0;
  bool saturated = false;
  for (std::size_t i = 0; i < script_.cameras.size(); ++i) {
    figures_.bloomed_views += record.result.cameras[i].bloomed;
    if (!record.result.cameras[i].used) continue;
    const exposure::CameraLight& light = record.light[i];
    ++judged;
    if (!near_target(light.peak_dn)) ++off;
    if (light.saturated_px <= kSaturated_px) continue;
    saturated = true;
    ++figures_.saturated;
  }
  settled_.push_back(judged > 0 && !saturated && 8 * off <= judged);
}

void LightTally::note_faults(const telemetry::CycleRecord& record) {
  for (std::size_t i = 0; i < script_.cameras.size(); ++i) {
    if (!record.unhealthy_irises.contains(i) || named_.contains(i)) continue;
    named_.insert(i);
    figures_.faults.push_back(
        fmt::format("{} at {:.1f} s", script_.cameras[i],
                    static_cast<double>(figures_.ticks) / script_.frame_rate_hz));
  }
}

void LightTally::do_write(const telemetry::CycleRecord& record) {
  count_cameras(record);
  note_faults(record);
  ++figures_.ticks;
  locked_ = locked_ || record.result.has_pose;
  const bool lost = locked_ && !record.result.has_pose;
  gap_ = lost ? gap_ + 1 : 0;
  figures_.without_pose += lost ? 1 : 0;
  figures_.longest_gap = std::max(figures_.longest_gap, gap_);
}

std::size_t LightTally::tick_of(double time_s) const {
  return std::min(static_cast<std::size_t>(std::ceil(time_s * script_.frame_rate_hz)),
                  settled_.size());
}

// A change that the next one, or the end, follows too soon to tell does not count.
double LightTally::settled_after_s() const {
  const std::vector<double>& changes_s = script_.changes_s;
  const auto held = static_cast<std::size_t>(std::lround(kHeld_s * script_.frame_rate_hz));
  double longest_s = 0.0;
  for (std::size_t i = 0; i < changes_s.size(); ++i) {
    const std::size_t from = tick_of(changes_s[i]);
    const std::size_t to = i + 1 < changes_s.size() ? tick_of(changes_s[i + 1]) : settled_.size();
    if (from + held >= to) continue;
    std::size_t run = 0;
    std::size_t tick = from;
    for (; tick < to && run < held; ++tick) run = settled_[tick] ? run + 1 : 0;
    if (run < held) return -1.0;
    const double after_s = static_cast<double>(tick - held - from) / script_.frame_rate_hz;
    longest_s = std::max(longest_s, after_s);
  }
  return longest_s;
}

LightFigures LightTally::figures() const {
  LightFigures figures = figures_;
  figures.settled_after_s = settled_after_s();
  return figures;
}

}  // namespace dottrack::workstation
