#include "app/workstation/light_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/workstation/sim_run.h"
#include "host_sim/scenarios/scenario_file.h"
#include "host_sim/scenarios/scene_renderer.h"

namespace dottrack::workstation {
namespace {

constexpr int kSaturated_px = 2;  // of a camera's dots: a glint
constexpr double kTarget_dn = 191.0;
constexpr double kNearTarget = 1.3;  // as bright as it should be
constexpr double kHeld_s = 0.4;      // so long it has to stay so
constexpr std::array kScenarios = {"drive", "lights", "sun_blooming", "iris_drift", "iris_stuck"};

bool near_target(int peak_dn) {
  return peak_dn < kNearTarget * kTarget_dn && peak_dn * kNearTarget > kTarget_dn;
}

std::string seconds(double s) {
  return s < 0.0 ? "never" : fmt::format("{:.1f}", s);
}

Result<LightFigures> run(const host_sim::Scene& scene, host_sim::SceneRenderer& renderer,
                         const LightRunOptions& options, const std::string& what) {
  LightTally tally(scene);
  SimOptions sim;
  sim.out = options.out / what;
  sim.pictures = false;
  sim.more = &tally;
  sim.go_on = [&](std::uint64_t tick) {
    return !options.go_on ||
           options.go_on(fmt::format("{}: tick {} of {}", what, tick, scene.ticks));
  };
  const auto done = simulate(scene, renderer, sim);
  if (!done) return tl::unexpected<Error>(done.error());
  if (!done->loop.output_fault.empty()) return fail(done->loop.output_fault);
  if (done->rows.size() < done->ticks_asked) return fail("stopped");
  LightFigures figures = tally.figures();
  figures.position_rms_mm = done->accuracy.position_rms_mm;
  return figures;
}

Result<host_sim::Scene> load(const std::string& name, std::uint64_t ticks) {
  const auto file = host_sim::find_scenario(name);
  if (!file) return tl::unexpected<Error>(file.error());
  auto scene = host_sim::load_scenario(*file, {});
  if (scene && ticks > 0) scene->ticks = std::min(scene->ticks, ticks);
  return scene;
}

std::string row(const std::string& scenario, const char* control, const LightFigures& f) {
  return fmt::format("| {} | {} | {} | {} | {} | {:.2f} | {} | {} | {} | {} |\n", scenario, control,
                     f.ticks, f.without_pose, f.longest_gap, f.position_rms_mm, f.bloomed_views,
                     f.saturated, seconds(f.settled_after_s), fmt::join(f.faults, ", "));
}

}  // namespace

LightTally::LightTally(const host_sim::Scene& scene) : scene_(scene), changes_s_{0.0} {
  for (const host_sim::LightChange& change : scene.world.light.changes) {
    if (change.at_s > 0.0) changes_s_.push_back(change.at_s + change.over_s);
  }
  std::sort(changes_s_.begin(), changes_s_.end());
}

void LightTally::count_cameras(const telemetry::CycleRecord& record) {
  int judged = 0;
  int off = 0;
  bool saturated = false;
  for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
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
  for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
    if (!record.unhealthy_irises.contains(i) || named_.contains(i)) continue;
    named_.insert(i);
    figures_.faults.push_back(
        fmt::format("{} at {:.1f} s", scene_.cameras[i].name,
                    static_cast<double>(figures_.ticks) / scene_.frame_rate_hz));
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

LightFigures LightTally::figures() const {
  LightFigures figures = figures_;
  const auto tick_of = [&](double s) {
    return std::min(static_cast<std::size_t>(std::ceil(s * scene_.frame_rate_hz)), settled_.size());
  };
  const auto held = static_cast<std::size_t>(std::lround(kHeld_s * scene_.frame_rate_hz));
  for (std::size_t i = 0; i < changes_s_.size(); ++i) {
    const std::size_t from = tick_of(changes_s_[i]);
    const std::size_t to = i + 1 < changes_s_.size() ? tick_of(changes_s_[i + 1]) : settled_.size();
    if (from + held >= to) continue;
    std::size_t run = 0;
    std::size_t tick = from;
    for (; tick < to && run < held; ++tick) run = settled_[tick] ? run + 1 : 0;
    if (run < held) {
      figures.settled_after_s = -1.0;
      return figures;
    }
    const double after_s = static_cast<double>(tick - held - from) / scene_.frame_rate_hz;
    figures.settled_after_s = std::max(figures.settled_after_s, after_s);
  }
  return figures;
}

Result<std::vector<LightComparison>> compare_light(const LightRunOptions& options) {
  std::vector<LightComparison> comparisons;
  for (const char* name : kScenarios) {
    auto scene = load(name, options.ticks);
    if (!scene) return tl::unexpected<Error>(scene.error());
    host_sim::SceneRenderer renderer(*scene, options.threads);
    LightComparison comparison{.scenario = name, .off = {}, .on = {}};
    for (const bool on : {false, true}) {
      scene->light_control = on;
      const auto figures =
          run(*scene, renderer, options, fmt::format("{}_{}", name, on ? "on" : "off"));
      if (!figures) return tl::unexpected<Error>(figures.error());
      (on ? comparison.on : comparison.off) = *figures;
    }
    comparisons.push_back(std::move(comparison));
  }
  return comparisons;
}

std::string table_of(const std::vector<LightComparison>& comparisons) {
  std::string text =
      "| scenario | control | ticks | without a pose | longest gap | position RMS, mm "
      "| bloomed dot views | pictures with saturated dots | settled after, s | irises named |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const LightComparison& c : comparisons) {
    text += row(c.scenario, "off", c.off) + row(c.scenario, "on", c.on);
  }
  return text;
}

}  // namespace dottrack::workstation
