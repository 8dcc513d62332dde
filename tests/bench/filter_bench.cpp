// One tick of the filter: twelve cameras' views, synchronised and not.

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "app/core/estimation/pose_filter.h"

namespace dottrack::bench {
namespace {

using estimation::PoseFilter;
using estimation::PoseInformation;

constexpr int kCameras = 12;

// Eight coordinates a camera of a vehicle that stands still.
std::vector<PoseInformation> views_of_tick(Duration apart, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<PoseInformation> tick(kCameras);
  for (int i = 0; i < kCameras; ++i) {
    PoseInformation& views = tick[static_cast<std::size_t>(i)];
    views.captured = Time(std::chrono::milliseconds(33)) + i * apart;
    views.coordinates = 8;
    for (int row = 0; row < views.coordinates; ++row) {
      const auto j =
          estimation::Vector6d::NullaryExpr([&] { return 500.0 * normal(random); }).eval();
      views.information += j * j.transpose();
      views.gradient += normal(random) * j;
    }
  }
  return tick;
}

void filter_tick(benchmark::State& state, Duration apart) {
  std::mt19937_64 random(23);
  PoseFilter filter({});
  core::Pose pose;
  pose.covariance = 1e-6 * estimation::Matrix6d::Identity();
  filter.start(pose, Time{});
  const auto tick = views_of_tick(apart, random);
  int accepted = 0;
  for (auto _ : state) {
    PoseFilter next = filter;
    accepted = next.update(tick).accepted.size();
    benchmark::DoNotOptimize(next);
  }
  if (accepted != kCameras) state.SkipWithError("not all cameras were taken in");
}

void filter_coast(benchmark::State& state) {
  PoseFilter filter({});
  core::Pose pose;
  pose.covariance = 1e-6 * estimation::Matrix6d::Identity();
  filter.start(pose, Time{});
  for (auto _ : state) {
    estimation::MotionState later = filter.at(Time(std::chrono::milliseconds(500)));
    benchmark::DoNotOptimize(later);
  }
}

BENCHMARK_CAPTURE(filter_tick, synchronised, Duration::zero());
BENCHMARK_CAPTURE(filter_tick, one_after_another, std::chrono::milliseconds(2));
BENCHMARK(filter_coast);

}  // namespace
}  // namespace dottrack::bench
