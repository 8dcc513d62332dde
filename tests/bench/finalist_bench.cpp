// Finalists: from sightings to points that at least k cameras see, 48 dots among clutter.

#include <benchmark/benchmark.h>

#include "app/core/acquisition/finalist_search.h"
#include "tests/bench/room_views.h"

namespace dottrack::bench {
namespace {

constexpr std::uint64_t kUnlimited = 1ULL << 60U;
constexpr std::size_t kDots = 48;

void find_finalists(benchmark::State& state) {
  const auto min_views = static_cast<int>(state.range(0));
  const RoomViews room(kDots, static_cast<std::size_t>(state.range(1)));
  acquisition::FinalistSearch search;
  core::AcquisitionCounts counts;
  for (auto _ : state) {
    counts = {};
    acquisition::WorkBudget budget(kUnlimited);
    search.start(room.views(), kRoomDiameter_m);
    search.advance(min_views, budget, counts);
    counts.work_units = budget.spent();
  }
  if (counts.finalists < kDots / 2) state.SkipWithError("dots are missing");
  state.counters["pairs"] = counts.pairs_accepted;
  state.counters["finalists"] = counts.finalists;
  state.counters["units"] = static_cast<double>(counts.work_units);
}

BENCHMARK(find_finalists)
    ->Name("finalists")
    ->ArgsProduct({{4, 3, 2}, {200, 280, 500}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace dottrack::bench
