// What light control takes a tick, with 12 cameras full of clutter that all see the target.

#include <benchmark/benchmark.h>

#include <memory>

#include "app/core/exposure/light_control.h"
#include "app/core/tracker.h"
#include "tests/bench/room_scene.h"

namespace dottrack::bench {
namespace {

void light_control(benchmark::State& state) {
  const RoomScene scene(static_cast<std::size_t>(state.range(0)));
  const core::Rig rig = scene.rig();
  const auto frames = scene.frames();
  core::Tracker tracker(rig);
  const core::TickResult result = tracker.step(frames);
  exposure::LightSettings settings;
  settings.on = true;
  const auto control = std::make_unique<exposure::LightControl>(rig, settings);
  const exposure::IrisView iris{1.0, false, false, true};
  for (auto _ : state) {
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) control->read(i, frames[i], result);
    control->end_readings(result);
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      benchmark::DoNotOptimize(control->decide(i, iris));
    }
  }
  if (!result.has_pose || control->light(0).peak_dn == 0) state.SkipWithError("nothing to measure");
}

[[maybe_unused]] const bool registered = [] {
  benchmark::RegisterBenchmark("light/12cameras", light_control)
      ->Arg(4)
      ->Arg(8)
      ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
}  // namespace dottrack::bench
