// The whole tracker on 12 cameras full of clutter. One iteration is one tick.

#include <benchmark/benchmark.h>

#include <memory>

#include "app/core/acquisition/acquisition.h"
#include "app/core/acquisition/sightings.h"
#include "app/core/image/band.h"
#include "app/core/tracker.h"
#include "tests/bench/room_scene.h"
#include "tests/bench/sim_scene.h"

namespace dottrack::bench {
namespace {

bool is_right(const core::TickResult& result, const Eigen::Vector3d& place_m) {
  return result.has_pose && (result.pose.position_m - place_m).norm() < 0.01;
}

// A tick with the frames, then one without any, which loses the target again and costs nothing.
template <class Scene>
void acquire(benchmark::State& state, const Scene& scene) {
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
    right = right && is_right(result, scene.place_m()) && result.acquisition.finalists > 0;
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

void acquire_heavy(benchmark::State& state) {
  acquire(state, RoomScene(static_cast<std::size_t>(state.range(0))));
}

void acquire_sim(benchmark::State& state) {
  acquire(state, SimScene::of(static_cast<std::size_t>(state.range(0))));
}

void track_at(benchmark::State& state, int watch_every_ticks) {
  RoomScene scene(static_cast<std::size_t>(state.range(0)));
  core::Rig rig = scene.rig();
  rig.limits.watch_every_ticks = watch_every_ticks;
  core::Tracker tracker(rig);
  const auto frames = scene.frames();
  tracker.step(frames);
  bool right = true;
  for (auto _ : state) {
    const core::TickResult& result = tracker.step(frames);
    right = right && is_right(result, RoomScene::place_m()) && result.reset_count == 1;
  }
  if (!right) state.SkipWithError("the target was not tracked");
}

void track(benchmark::State& state) {
  track_at(state, 0);
}

void track_and_watch(benchmark::State& state) {
  track_at(state, 1);
}

// As the tracker looks through the simulator's images.
void identify_sim(benchmark::State& state) {
  const SimScene& scene = SimScene::of(4);
  const auto frames = scene.frames();
  const auto identifier = std::make_unique<image::Identifier>();
  const auto regions = std::make_unique<image::Regions>();
  std::array<image::RegionGate, kMaxCameras> gates;
  for (std::size_t i = 0; i < scene.rig().cameras.size(); ++i) {
    const core::Camera& camera = scene.rig().cameras[i];
    const geometry::Optics optics(camera.model, camera.width_px, camera.height_px);
    gates[i] = acquisition::acquisition_gate(camera, optics, scene.rig().target);
  }
  std::uint32_t accepted = 0;
  for (auto _ : state) {
    accepted = 0;
    for (std::size_t i = 0; i < scene.rig().cameras.size(); ++i) {
      accepted += identifier
                      ->identify(frames[i].image, image::band_of(scene.rig().cameras[i]), gates[i],
                                 *regions)
                      .accepted;
    }
  }
  if (accepted < 4) state.SkipWithError("identify found too few regions");
  state.counters["regions"] = accepted;
}

BENCHMARK(identify_sim)->Name("identify/sim")->Unit(benchmark::kMicrosecond);
BENCHMARK(acquire_heavy)->Name("acquire/heavy")->Arg(4)->Arg(8)->Unit(benchmark::kMicrosecond);
BENCHMARK(acquire_sim)->Name("acquire/sim")->Arg(4)->Arg(8)->Unit(benchmark::kMicrosecond);
BENCHMARK(track)->Name("track/12cameras")->Arg(4)->Arg(8)->Unit(benchmark::kMicrosecond);
BENCHMARK(track_and_watch)
    ->Name("track_and_watch/12cameras")
    ->Arg(4)
    ->Arg(8)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace dottrack::bench
