// Match: candidate pairs between all 66 pairs of 12 cameras, and their merging into finalists.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "app/core/acquisition/finalists.h"
#include "app/core/acquisition/match.h"
#include "tests/bench/room_scene.h"

namespace dottrack::bench {
namespace {

constexpr double kDiameter_m = 0.1;
constexpr std::uint64_t kUnlimited = 1ULL << 60U;

// A dot of the room at a pixel of its own in one camera: no two cameras need see the same dots.
bool look(const core::Camera& camera, const geometry::Optics& optics, std::mt19937& random,
          estimation::Sighting& sighting) {
  const Eigen::Vector3d point = point_in_room(random);
  image::Region region;
  if (geometry::project(camera.model, point, region.centroid_px) != geometry::OpticsStatus::ok) {
    return false;
  }
  const auto& p = region.centroid_px;
  if (p.x() < 10.0 || p.y() < 10.0 || p.x() > kSetWidth - 10.0 || p.y() > kSetHeight - 10.0) {
    return false;
  }
  const double range_m = (point - geometry::centre(camera.model)).norm();
  const double r = 0.5 * kDiameter_m / range_m * optics.at(p).mean_px();
  region.semi_major_px = region.semi_minor_px = r;
  region.x_min = static_cast<std::int16_t>(p.x() - r);
  region.x_max = static_cast<std::int16_t>(p.x() + r);
  region.y_min = static_cast<std::int16_t>(p.y() - r);
  region.y_max = static_cast<std::int16_t>(p.y() + r);
  return estimation::make_sighting(camera, optics, {kDiameter_m, kDiameter_m}, region, sighting);
}

void fill(acquisition::CameraView& view, const core::Camera& camera, std::size_t sightings,
          std::mt19937& random) {
  const geometry::Optics optics(camera.model, camera.width_px, camera.height_px);
  view.camera = &camera;
  while (view.sightings.size() < sightings) {
    estimation::Sighting sighting;
    if (!look(camera, optics, random, sighting)) continue;
    sighting.region = static_cast<std::uint16_t>(view.sightings.size());
    view.sightings.push_back(sighting);
  }
}

void match(benchmark::State& state) {
  const core::Rig rig = room_rig(4);
  std::mt19937 random(11);
  std::vector<acquisition::CameraView> views(rig.cameras.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    fill(views[i], rig.cameras[i], static_cast<std::size_t>(state.range(0)), random);
  }
  const auto matcher = std::make_unique<acquisition::Matcher>();
  const auto merger = std::make_unique<acquisition::FinalistMerger>();
  const auto pairs = std::make_unique<acquisition::CandidatePairs>();
  core::AcquisitionCounts counts;
  for (auto _ : state) {
    counts = {};
    acquisition::WorkBudget budget(kUnlimited);
    merger->start(2.0 * kDiameter_m);
    for (std::size_t a = 0; a < views.size(); ++a) {
      for (std::size_t b = a + 1; b < views.size(); ++b) {
        pairs->clear();
        matcher->match(views, a, b, kDiameter_m, *pairs, counts, budget);
        for (const auto& pair : *pairs) merger->merge(views, pair, counts, budget);
      }
    }
    benchmark::DoNotOptimize(merger->finalists().size());
  }
  if (counts.pairs_accepted == 0) state.SkipWithError("no pairs");
  state.counters["tested"] = counts.pairs_tested;
  state.counters["accepted"] = counts.pairs_accepted;
  state.counters["finalists"] = static_cast<double>(merger->finalists().size());
}

BENCHMARK(match)->Arg(50)->Arg(100)->Arg(200)->Arg(500)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace dottrack::bench
