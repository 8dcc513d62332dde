// Select: n dots among F finalists that lie about in a room; the target's are among them.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "app/core/acquisition/select.h"
#include "hal/base/static_vector.h"
#include "tests/bench/room_scene.h"

namespace dottrack::bench {
namespace {

constexpr double kResidual_m = 0.02;
constexpr std::uint64_t kUnlimited = 1ULL << 60U;

// `dots` of the target's dots, and others.
std::vector<acquisition::DotCandidate> candidates_of(const core::Target& target, std::size_t dots,
                                                     std::size_t count) {
  std::mt19937 random(13);
  std::normal_distribution<double> noise(0.0, 0.004);
  std::vector<acquisition::DotCandidate> candidates;
  for (const core::TargetDot& dot : as_span(target.dots).first(dots)) {
    const Eigen::Vector3d error(noise(random), noise(random), noise(random));
    candidates.push_back({RoomScene::place_m() + dot.position_m + error, 0.1 + noise(random)});
  }
  while (candidates.size() < count) {
    candidates.push_back({point_in_room(random), 0.1 + 4.0 * noise(random)});
  }
  std::shuffle(candidates.begin(), candidates.end(), random);
  return candidates;
}

std::size_t argument(const benchmark::State& state, std::size_t i) {
  return static_cast<std::size_t>(state.range(i));
}

acquisition::SelectStatus time_selection(benchmark::State& state,
                                         const acquisition::TargetShape& shape,
                                         std::span<const acquisition::DotCandidate> candidates,
                                         std::size_t dots) {
  acquisition::Selector selector;
  acquisition::Selection selection;
  acquisition::SelectStatus status{};
  for (auto _ : state) {
    acquisition::WorkBudget budget(kUnlimited);
    selector.start(shape, candidates, {acquisition::largest_score(shape, kResidual_m, dots), dots});
    status = selector.advance(budget, selection);
    benchmark::DoNotOptimize(selection);
  }
  return status;
}

// All dots of a target that is there: dots, candidates.
void select(benchmark::State& state) {
  const core::Target target = room_rig(argument(state, 0)).target;
  const auto shape = acquisition::make_target_shape(target);
  const auto candidates = candidates_of(target, shape.dots, argument(state, 1));
  if (time_selection(state, shape, candidates, shape.dots) != acquisition::SelectStatus::found) {
    state.SkipWithError("the target was not found");
  }
}

BENCHMARK(select)
    ->Args({3, 200})
    ->Args({4, 200})
    ->Args({8, 200})
    ->Args({4, 1000})
    ->Args({8, 1000})
    ->Unit(benchmark::kMicrosecond);

// m of n dots, of which some are there: m, n, there, candidates.
void select_part(benchmark::State& state) {
  const core::Target target = room_rig(argument(state, 1)).target;
  const auto candidates = candidates_of(target, argument(state, 2), argument(state, 3));
  time_selection(state, acquisition::make_target_shape(target), candidates, argument(state, 0));
}

BENCHMARK(select_part)
    ->Args({4, 4, 0, 200})
    ->Args({8, 8, 0, 200})
    ->Args({4, 8, 8, 200})
    ->Args({4, 8, 4, 200})
    ->Args({4, 8, 0, 200})
    ->Args({6, 8, 0, 200})
    ->Args({8, 8, 0, 1000})
    ->Args({4, 8, 0, 1000})
    ->Unit(benchmark::kMicrosecond);

// All capacities full: as many candidates as there can be, on a lattice that fits the edges of a
// target from the same lattice everywhere. Without end for all that matters; a budget of a hundred
// thousand units, then, and how far it is overdrawn at most.
void select_lattice_slices(benchmark::State& state) {
  constexpr int kSide = 20;
  constexpr double kStep_m = 0.25;
  constexpr std::uint64_t kSlice = 100'000;
  core::Target target;
  for (int i = 0; i < static_cast<int>(core::kMaxDots); ++i) {
    target.dots.push_back({kStep_m * Eigen::Vector3d(i % 4, i / 4, i % 3 == 0 ? 1 : 0), 0.1, {}});
  }
  std::vector<acquisition::DotCandidate> candidates;
  for (int i = 0; i < static_cast<int>(core::kMaxFinalists); ++i) {
    const Eigen::Vector3d corner(i % kSide, i / kSide % kSide, i / (kSide * kSide));
    candidates.push_back({kStep_m * corner, 0.1});
  }
  const auto shape = acquisition::make_target_shape(target);
  const acquisition::SelectLimits limits{acquisition::largest_score(shape, kResidual_m, 8), 8};
  acquisition::Selector selector;
  acquisition::Selection selection;
  std::uint64_t most = 0;
  selector.start(shape, candidates, limits);
  for (auto _ : state) {
    acquisition::WorkBudget budget(kSlice);
    selector.advance(budget, selection);
    most = std::max(most, budget.spent());
  }
  state.counters["overdrawn_units"] = static_cast<double>(most - std::min(most, kSlice));
}

BENCHMARK(select_lattice_slices)->Unit(benchmark::kMicrosecond);

using Subset = std::array<std::uint16_t, 4>;

std::vector<Subset> random_subsets(std::size_t candidates, std::size_t count) {
  std::mt19937 random(17);
  std::uniform_int_distribution<std::uint16_t> any(0, static_cast<std::uint16_t>(candidates - 1));
  std::vector<Subset> subsets;
  while (subsets.size() < count) {
    Subset subset{any(random), any(random), any(random), any(random)};
    std::sort(subset.begin(), subset.end());
    if (std::adjacent_find(subset.begin(), subset.end()) == subset.end()) subsets.push_back(subset);
  }
  return subsets;
}

double variance_m2(std::span<const acquisition::DotCandidate> candidates, const Subset& subset) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint16_t c : subset) mean += 0.25 * candidates[c].position_m;
  double sum = 0.0;
  for (const std::uint16_t c : subset) sum += (candidates[c].position_m - mean).squaredNorm();
  return 0.25 * sum;
}

double variance_of(const core::Target& target) {
  std::vector<acquisition::DotCandidate> dots;
  for (const core::TargetDot& dot : target.dots) dots.push_back({dot.position_m, dot.diameter_m});
  return variance_m2(dots, {0, 1, 2, 3});
}

// The paper's search among 200 candidates for four dots takes too long to be timed whole: this is a
// thousandth of its C(200, 4) subsets, drawn at random. Those that pass the variance test are
// scored in every permutation.
void select_brute_force_thousandth(benchmark::State& state) {
  constexpr std::size_t kDots = 4;
  constexpr std::size_t kSubsets = 64'684'950 / 1000;
  const core::Target target = room_rig(kDots).target;
  const auto shape = acquisition::make_target_shape(target);
  const auto candidates = candidates_of(target, kDots, 200);
  const double largest_m2 = 2.0 * variance_of(target);
  const auto subsets = random_subsets(candidates.size(), kSubsets);
  for (auto _ : state) {
    double best_m2 = acquisition::largest_score(shape, kResidual_m, kDots);
    for (Subset subset : subsets) {
      if (variance_m2(candidates, subset) > largest_m2) continue;
      do {
        acquisition::Assignment assignment;
        assignment.fill(acquisition::kNoCandidate);
        std::copy(subset.begin(), subset.end(), assignment.begin());
        best_m2 = std::min(best_m2, acquisition::match_score(shape, candidates, assignment));
      } while (std::next_permutation(subset.begin(), subset.end()));
    }
    benchmark::DoNotOptimize(best_m2);
  }
}

BENCHMARK(select_brute_force_thousandth)
    ->Name("select_brute_force/4/200/a_thousandth_of_it")
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace dottrack::bench
