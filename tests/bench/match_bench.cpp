// Match: candidate pairs between all 66 pairs of 12 cameras, and finalists from them.

#include <benchmark/benchmark.h>

#include <memory>

#include "app/core/acquisition/finalist_search.h"
#include "app/core/acquisition/match.h"
#include "tests/bench/room_views.h"

namespace dottrack::bench {
namespace {

constexpr std::uint64_t kUnlimited = 1ULL << 60U;

// The first step alone.
void match_pairs(benchmark::State& state) {
  const RoomViews room(0, static_cast<std::size_t>(state.range(0)));
  const auto matcher = std::make_unique<acquisition::Matcher>();
  const auto pairs = std::make_unique<acquisition::CandidatePairs>();
  core::AcquisitionCounts counts;
  for (auto _ : state) {
    counts = {};
    acquisition::WorkBudget budget(kUnlimited);
    matcher->start();
    for (std::size_t a = 0; a < room.views().size(); ++a) {
      for (std::size_t b = a + 1; b < room.views().size(); ++b) {
        pairs->clear();
        std::size_t next = 0;
        matcher->match(room.views(), a, b, kRoomDiameter_m, *pairs, counts, budget, next);
      }
    }
    counts.work_units = budget.spent();
  }
  if (counts.pairs_accepted == 0) state.SkipWithError("no pairs");
  state.counters["tested"] = counts.pairs_tested;
  state.counters["accepted"] = counts.pairs_accepted;
  state.counters["units"] = static_cast<double>(counts.work_units);
}

// Both steps: finalists of two views and more.
void match(benchmark::State& state) {
  const RoomViews room(0, static_cast<std::size_t>(state.range(0)));
  acquisition::FinalistSearch search;
  core::AcquisitionCounts counts;
  for (auto _ : state) {
    counts = {};
    acquisition::WorkBudget budget(kUnlimited);
    search.start(room.views(), kRoomDiameter_m);
    search.advance(2, budget, counts);
    counts.work_units = budget.spent();
  }
  if (search.finalists().empty()) state.SkipWithError("no finalists");
  state.counters["accepted"] = counts.pairs_accepted;
  state.counters["finalists"] = static_cast<double>(search.finalists().size());
  state.counters["units"] = static_cast<double>(counts.work_units);
}

BENCHMARK(match_pairs)->Arg(50)->Arg(100)->Arg(200)->Arg(500)->Unit(benchmark::kMicrosecond);
BENCHMARK(match)->Arg(50)->Arg(100)->Arg(200)->Arg(500)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace dottrack::bench
