// Identify on 12 images, against the yardstick and OpenCV. One iteration is the whole set.

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "app/core/image/identify.h"
#include "tests/bench/blob_scene.h"
#include "tests/bench/byte_sum.h"
#include "tests/bench/opencv_agreement.h"
#include "tests/bench/opencv_identify.h"

namespace dottrack::bench {
namespace {

const PictureSet& sparse() {
  static const PictureSet set = sparse_set();
  return set;
}

const PictureSet& heavy() {
  static const PictureSet set = heavy_set();
  return set;
}

// The gates of an acquisition with dots of 3 to 16 pixels.
constexpr image::RegionGate kGate{
    .semi_major_min_px = 1.5, .semi_major_max_px = 8.0, .min_axis_ratio = 0.3, .min_fill = 0.7};

void byte_sum_of_set(benchmark::State& state) {
  for (auto _ : state) {
    std::uint64_t sum = 0;
    for (const Picture& picture : sparse()) sum += byte_sum(picture.view());
    benchmark::DoNotOptimize(sum);
  }
}

void identify(benchmark::State& state, const PictureSet& set, const image::Band& band) {
  const auto identifier = std::make_unique<image::Identifier>();
  const auto regions = std::make_unique<image::Regions>();
  image::IdentifyCounts total;
  for (auto _ : state) {
    total = {};
    for (const Picture& picture : set) {
      const auto counts = identifier->identify(picture.view(), band, kGate, *regions);
      total.runs += counts.runs;
      total.accepted += counts.accepted;
    }
    benchmark::DoNotOptimize(total);
  }
  if (total.accepted < 12 * 90) state.SkipWithError("identify found too few regions");
  state.counters["regions"] = total.accepted;
  state.counters["runs"] = total.runs;
}

void identify_windows(benchmark::State& state) {
  const auto identifier = std::make_unique<image::Identifier>();
  const auto regions = std::make_unique<image::Regions>();
  for (auto _ : state) {
    for (const Picture& picture : sparse()) {
      benchmark::DoNotOptimize(identifier->identify(
          picture.view(), {101, 103, 164, 162}, {.intensity_min_dn = kBandMin}, kGate, *regions));
    }
  }
}

void opencv(benchmark::State& state, const PictureSet& set,
            std::size_t (*regions_of)(const ImageView&)) {
  use_one_opencv_thread();
  std::size_t regions = 0;
  for (auto _ : state) {
    regions = 0;
    for (const Picture& picture : set) regions += regions_of(picture.view());
    benchmark::DoNotOptimize(regions);
  }
  if (regions < 12 * 90) state.SkipWithError("OpenCV found too few regions");
  for (const Picture& picture : set) {
    const std::string difference = opencv_disagrees(picture.view(), kGate);
    if (!difference.empty()) state.SkipWithError(difference.c_str());
  }
}

constexpr image::Band kBand{.intensity_min_dn = kBandMin};
constexpr image::Band kContrast{.min_contrast_dn = 40, .background_px = 21};

[[maybe_unused]] const bool registered = [] {
  const auto us = benchmark::kMicrosecond;
  const auto add = [us](const char* name, auto run, auto... with) {
    benchmark::RegisterBenchmark(name, run, with...)->Unit(us);
  };
  add("byte_sum", byte_sum_of_set);
  add("identify/sparse", [](auto& state) { identify(state, sparse(), kBand); });
  add("identify/heavy", [](auto& state) { identify(state, heavy(), kBand); });
  add("identify/local_background", [](auto& state) { identify(state, sparse(), kContrast); });
  add("identify/12windows", identify_windows);
  add("opencv/contours/sparse", [](auto& state) { opencv(state, sparse(), opencv_contours); });
  add("opencv/contours/heavy", [](auto& state) { opencv(state, heavy(), opencv_contours); });
  add("opencv/connected_components/sparse",
      [](auto& state) { opencv(state, sparse(), opencv_connected_components); });
  add("opencv/connected_components/heavy",
      [](auto& state) { opencv(state, heavy(), opencv_connected_components); });
  return true;
}();

}  // namespace
}  // namespace dottrack::bench
