// Match and select: from twelve cameras' sightings to the candidate with its proof, the target
// among clutter; neither identify nor the confirming run.

#include <benchmark/benchmark.h>

#include <array>
#include <memory>
#include <vector>

#include "app/core/acquisition/acquisition.h"
#include "tests/bench/room_views.h"

namespace dottrack::bench {
namespace {

constexpr std::uint64_t kUnlimited = 1ULL << 60U;

bool is_right(const acquisition::AcquisitionResult& result, const core::Rig& rig) {
  return result.reason == core::Reason::none &&
         result.counts.false_lock_probability <= rig.limits.max_false_lock_probability &&
         (result.candidate.pose.position_m - RoomScene::place_m()).norm() < 0.01;
}

void match_and_select(benchmark::State& state) {
  const core::Rig rig = room_rig(static_cast<std::size_t>(state.range(0)));
  const RoomRegions room(rig, static_cast<std::size_t>(state.range(1)));
  std::vector<geometry::Optics> optics;
  for (const core::Camera& camera : rig.cameras) {
    optics.emplace_back(camera.model, camera.width_px, camera.height_px);
  }
  acquisition::Acquisition acquisition(rig, optics);
  bool right = true;
  for (auto _ : state) {
    acquisition::WorkBudget budget(kUnlimited);
    acquisition.start(room.regions(), budget);
    right = acquisition.go_on(budget) && is_right(acquisition.result(), rig) && right;
  }
  if (!right) state.SkipWithError("the target was not found");
  const core::AcquisitionCounts& counts = acquisition.result().counts;
  state.counters["finalists"] = counts.finalists;
  state.counters["min_views"] = counts.min_views;
  state.counters["units"] = static_cast<double>(counts.work_units);
}

BENCHMARK(match_and_select)->ArgsProduct({{4, 8}, {200, 500}})->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace dottrack::bench
