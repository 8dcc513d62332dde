// One tick's part of the worst search there is, with all capacities full: what the bound of work is
// worth in time.

#include <benchmark/benchmark.h>

#include <memory>

#include "app/core/acquisition/acquisition.h"
#include "app/core/searcher.h"
#include "tests/support/lattice_scene.h"

namespace dottrack::bench {
namespace {

void worst_case(benchmark::State& state) {
  const auto scene = std::make_unique<test::LatticeScene>();
  const auto acquisition = std::make_unique<acquisition::Acquisition>(scene->rig, scene->optics);
  std::uint64_t most = 0;
  for (auto _ : state) {
    acquisition::WorkBudget budget(core::Searcher::kWorkUnits);
    if (!acquisition->busy()) acquisition->start(scene->regions(), budget);
    acquisition->go_on(budget);
    most = std::max(most, budget.spent());
  }
  state.counters["most_units"] = static_cast<double>(most);
}

BENCHMARK(worst_case)->Name("worst_case/tick")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace dottrack::bench
