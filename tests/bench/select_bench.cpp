// Select: n dots among F finalists that lie about in a room; the target's are among them.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "app/core/acquisition/select.h"
#include "tests/bench/room_scene.h"

namespace dottrack::bench {
namespace {

constexpr double kResidual_m = 0.02;
constexpr std::uint64_t kUnlimited = 1ULL << 60U;

std::vector<acquisition::DotCandidate> candidates_of(const core::Target& target, std::size_t count,
                                                     std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, 0.004);
  std::vector<acquisition::DotCandidate> candidates;
  for (const core::TargetDot& dot : target.dots) {
    const Eigen::Vector3d error(noise(random), noise(random), noise(random));
    candidates.push_back({RoomScene::place_m() + dot.position_m + error, 0.1 + noise(random)});
  }
  while (candidates.size() < count) {
    candidates.push_back({point_in_room(random), 0.1 + 4.0 * noise(random)});
  }
  std::shuffle(candidates.begin(), candidates.end(), random);
  return candidates;
}

void select(benchmark::State& state) {
  const core::Target target = room_rig(static_cast<std::size_t>(state.range(0))).target;
  const auto shape = acquisition::make_target_shape(target);
  std::mt19937 random(13);
  const auto candidates = candidates_of(target, static_cast<std::size_t>(state.range(1)), random);
  acquisition::Selector selector;
  acquisition::Selection selection;
  acquisition::SelectStatus status{};
  for (auto _ : state) {
    acquisition::WorkBudget budget(kUnlimited);
    selector.start(shape, candidates,
                   {acquisition::largest_score(shape, kResidual_m, shape.dots), shape.dots});
    status = selector.advance(budget, selection);
    benchmark::DoNotOptimize(selection);
  }
  if (status != acquisition::SelectStatus::found) state.SkipWithError("the target was not found");
}

BENCHMARK(select)
    ->Args({3, 200})
    ->Args({4, 200})
    ->Args({8, 200})
    ->Args({4, 1000})
    ->Args({8, 1000})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace dottrack::bench
