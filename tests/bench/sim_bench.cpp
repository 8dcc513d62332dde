// How fast the simulated sandbox is: whole ticks and whole acquisitions, rendering included, once
// the still hall is rendered. In real time, on all cores.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "app/workstation/sim_run.h"
#include "app/workstation/trial_summary.h"
#include "app/workstation/trials.h"
#include "host_sim/scenarios/scenario_file.h"
#include "host_sim/scenarios/scene_renderer.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::bench {
namespace {

constexpr std::uint64_t kTicks = 60;
constexpr std::uint64_t kPlacements = 30;

template <class T>
T value_or_throw(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

struct Sandbox {
  host_sim::Scene scene = value_or_throw(host_sim::load_scenario(
      value_or_throw(host_sim::find_scenario("drive")), {.seed = {}, .ticks = kTicks}));
  host_sim::SceneRenderer renderer{scene};
  test::TemporaryFolder folder;
};

Sandbox& sandbox() {
  static Sandbox instance;
  return instance;
}

void drive(benchmark::State& state) {
  Sandbox& s = sandbox();
  workstation::SimOptions options;
  options.out = s.folder.path() / "drive";
  options.pictures = false;
  for (auto _ : state) {
    const auto sim = value_or_throw(workstation::simulate(s.scene, s.renderer, options));
    if (sim.accuracy.wrong_lock_ticks > 0 || sim.loop.tracking_ticks == 0) {
      state.SkipWithError("the rover was not tracked");
    }
    state.SetIterationTime(1.0 / sim.ticks_per_s);
  }
}

void acquisitions(benchmark::State& state) {
  Sandbox& s = sandbox();
  workstation::TrialOptions options;
  options.out = s.folder.path() / "acquisitions";
  options.count = kPlacements;
  for (auto _ : state) {
    const auto run = value_or_throw(workstation::run_trials(s.scene, s.renderer, options));
    if (workstation::summary_of(run.trials, true).right == 0) {
      state.SkipWithError("the rover was never found");
    }
    state.SetIterationTime(1.0 / run.trials_per_s);
  }
}

BENCHMARK(drive)->Name("sim/drive_tick")->UseManualTime()->Iterations(1)->Repetitions(2);
BENCHMARK(acquisitions)->Name("sim/acquisition")->UseManualTime()->Iterations(1)->Repetitions(2);

}  // namespace
}  // namespace dottrack::bench
