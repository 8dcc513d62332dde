// The benchmarks. Repetitions of all of them are interleaved, so that a noisy minute of the machine
// falls on all alike; the ratios at the end are of the best repetition of each.

#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "tests/bench/ratio_table.h"

int main(int argc, char** argv) {
  std::array<char, 40> repetitions{"--benchmark_repetitions=7"};
  std::array<char, 40> min_time{"--benchmark_min_time=0.1"};
  std::array<char, 48> interleaved{"--benchmark_enable_random_interleaving=true"};
  // What the caller asks for comes later and wins.
  std::vector<char*> arguments{argv[0], repetitions.data(), min_time.data(), interleaved.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  dottrack::bench::RatioTable table;
  benchmark::RunSpecifiedBenchmarks(&table);
  benchmark::Shutdown();
  return table.any_failed() ? 1 : 0;
}
