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

constexpr std::array kScenarios = {"drive", "lights", "sun_blooming", "iris_drift", "iris_stuck"};

std::string seconds(double s) {
  return s < 0.0 ? "never" : fmt::format("{:.1f}", s);
}

LightScript script_of(const host_sim::Scene& scene) {
  LightScript script{.cameras = {}, .frame_rate_hz = scene.frame_rate_hz, .changes_s = {}};
  for (const host_sim::SceneCamera& camera : scene.cameras) script.cameras.push_back(camera.name);
  for (const host_sim::LightChange& change : scene.world.light.changes) {
    if (change.at_s > 0.0) script.changes_s.push_back(change.at_s + change.over_s);
  }
  return script;
}

Result<LightFigures> run(const host_sim::Scene& scene, host_sim::SceneRenderer& renderer,
                         const LightRunOptions& options, const std::string& what) {
  LightTally tally(script_of(scene));
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

void set_rate(double frame_rate_hz, host_sim::Scene& scene) {
  const double seconds = static_cast<double>(scene.ticks) / scene.frame_rate_hz;
  scene.ticks = static_cast<std::uint64_t>(std::llround(seconds * frame_rate_hz));
  scene.frame_rate_hz = frame_rate_hz;
}

Result<host_sim::Scene> load(const std::string& name, const LightRunOptions& options) {
  const auto file = host_sim::find_scenario(name);
  if (!file) return tl::unexpected<Error>(file.error());
  auto scene = host_sim::load_scenario(*file, {});
  if (!scene) return scene;
  if (options.frame_rate_hz > 0.0) set_rate(options.frame_rate_hz, *scene);
  if (options.ticks > 0) scene->ticks = std::min(scene->ticks, options.ticks);
  return scene;
}

std::string row(const std::string& scenario, const char* control, const LightFigures& f) {
  return fmt::format("| {} | {} | {} | {} | {} | {:.2f} | {} | {} | {} | {} |\n", scenario, control,
                     f.ticks, f.without_pose, f.longest_gap, f.position_rms_mm, f.bloomed_views,
                     f.saturated, seconds(f.settled_after_s), fmt::join(f.faults, ", "));
}

}  // namespace

Result<std::vector<LightComparison>> compare_light(const LightRunOptions& options) {
  std::vector<LightComparison> comparisons;
  for (const char* name : kScenarios) {
    auto scene = load(name, options);
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
