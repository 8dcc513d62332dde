#include "app/workstation/calibrate/fit/parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace dottrack::calibrate {

void for_each_index(std::size_t count, unsigned threads,
                    const std::function<void(std::size_t)>& work) {
  const unsigned wanted =
      threads == 0 ? std::max(1U, std::thread::hardware_concurrency()) : threads;
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < std::min<std::size_t>(wanted, count); ++i) others.emplace_back(run);
  run();
}

}  // namespace dottrack::calibrate
