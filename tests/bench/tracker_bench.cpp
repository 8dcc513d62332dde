// The whole tracker on 12 cameras full of clutter. One iteration is one tick.

#include <benchmark/benchmark.h>

#include "app/core/tracker.h"
#include "tests/bench/room_scene.h"

namespace dottrack::bench {
namespace {

bool is_right(const core::TickResult& result) {
  return result.has_pose && (result.pose.position_m - RoomScene::place_m()).norm() < 0.01;
}

// A tick with the frames, then one without any, which loses the target again and costs nothing.
void acquire(benchmark::State& state) {
  RoomScene scene(static_cast<std::size_t>(state.range(0)));
  core::Rig rig = scene.rig();
  rig.limits.lost_after_ticks = 1;
  core::Tracker tracker(rig);
  const auto frames = scene.frames();
  const std::array<core::CameraFrame, kMaxCameras> nothing{};
  bool right = true;
  core::AcquisitionCounts counts;
  std::uint32_t regions = 0;
  for (auto _ : state) {
    const core::TickResult& result = tracker.step(frames);
    right = right && is_right(result) && result.acquisition.finalists > 0;
    counts = result.acquisition;
    regions = result.cameras[0].regions;
    tracker.step(nothing);
  }
  if (!right) state.SkipWithError("the target was not acquired");
  state.counters["finalists"] = counts.finalists;
  state.counters["pairs"] = counts.pairs_accepted;
  state.counters["work_units"] = static_cast<double>(counts.work_units);
  state.counters["regions_of_camera_0"] = regions;
}

void track(benchmark::State& state) {
  RoomScene scene(static_cast<std::size_t>(state.range(0)));
  core::Tracker tracker(scene.rig());
  const auto frames = scene.frames();
  tracker.step(frames);
  bool right = true;
  for (auto _ : state) {
    const core::TickResult& result = tracker.step(frames);
    right = right && is_right(result) && result.reset_count == 1;
  }
  if (!right) state.SkipWithError("the target was not tracked");
}

BENCHMARK(acquire)->Name("acquire/heavy")->Arg(4)->Arg(8)->Unit(benchmark::kMicrosecond);
BENCHMARK(track)->Name("track/12cameras")->Arg(4)->Arg(8)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace dottrack::bench
