// A dot's centre and what is known of it, a view at a time, beside the centroid of its light.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>

#include "app/core/image/dot_centre.h"
#include "app/core/image/dot_fit.h"
#include "app/core/image/identify.h"

namespace dottrack::bench {
namespace {

constexpr int kSide_px = 200;
constexpr double kContrast_dn = 120.0;

// A disc with a soft edge on a slope, in noise.
class DotScene {
 public:
  explicit DotScene(double diameter_px) {
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0.0, 3.0);
    for (int y = 0; y < kSide_px; ++y) {
      for (int x = 0; x < kSide_px; ++x) {
        const double inside = 0.5 * diameter_px - std::hypot(x - 100.3, y - 100.1);
        const double covered = 0.5 * std::erfc(-inside / std::sqrt(2.0 * 0.5));
        const double grey = 60.0 + 0.1 * (x - 100) + kContrast_dn * covered + noise(random);
        bytes_[static_cast<std::size_t>(y * kSide_px + x)] =
            static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
      }
    }
    const auto identifier = std::make_unique<image::Identifier>();
    const auto regions = std::make_unique<image::Regions>();
    identifier->identify(view(), {.min_contrast_dn = 50, .background_px = 61}, {}, *regions);
    for (const image::Region& region : *regions) {
      if (region.area_px > region_.area_px) region_ = region;
    }
  }

  ImageView view() const { return {bytes_.data(), kSide_px, kSide_px, kSide_px}; }
  const image::Region& region() const { return region_; }

 private:
  std::array<std::uint8_t, static_cast<std::size_t>(kSide_px) * kSide_px> bytes_{};
  image::Region region_;
};

void dot_centre(benchmark::State& state, double diameter_px) {
  const auto scene = std::make_unique<DotScene>(diameter_px);
  for (auto _ : state) {
    benchmark::DoNotOptimize(image::dot_centre(scene->view(), scene->region()));
  }
}

void dot_fit(benchmark::State& state, double diameter_px) {
  const auto scene = std::make_unique<DotScene>(diameter_px);
  const image::ExpectedOutline expected{diameter_px / 2.0, diameter_px / 2.0, 0.0};
  image::DotFit fit;
  for (auto _ : state) {
    fit = image::fit_dot(scene->view(), scene->region(), &expected);
    benchmark::DoNotOptimize(fit);
  }
  if (fit.flaw != image::DotFlaw::none) state.SkipWithError("the dot was not recognised as whole");
}

[[maybe_unused]] const bool registered = [] {
  const auto ns = benchmark::kNanosecond;
  const auto add = [ns](const char* name, auto run, double diameter_px) {
    benchmark::RegisterBenchmark(name, run, diameter_px)->Unit(ns);
  };
  add("dot/centroid/8px", dot_centre, 8.0);
  add("dot/centroid/20px", dot_centre, 20.0);
  add("dot/fit/8px", dot_fit, 8.0);
  add("dot/fit/20px", dot_fit, 20.0);
  return true;
}();

}  // namespace
}  // namespace dottrack::bench
