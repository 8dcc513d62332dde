// Match: candidate pairs between all 66 pairs of 12 cameras, and finalists from them.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "app/core/acquisition/finalist_search.h"
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

// What the cameras of the room see: as many sightings in each, of no dots in common.
class RoomViews {
 public:
  explicit RoomViews(std::size_t sightings) : rig_(room_rig(4)), views_(rig_.cameras.size()) {
    std::mt19937 random(11);
    for (std::size_t i = 0; i < views_.size(); ++i) {
      fill(views_[i], rig_.cameras[i], sightings, random);
    }
  }
  std::span<const acquisition::CameraView> views() const { return views_; }

 private:
  core::Rig rig_;
  std::vector<acquisition::CameraView> views_;
};

// The first step alone.
void match_pairs(benchmark::State& state) {
  const RoomViews room(static_cast<std::size_t>(state.range(0)));
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
        matcher->match(room.views(), a, b, kDiameter_m, *pairs, counts, budget, next);
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
  const RoomViews room(static_cast<std::size_t>(state.range(0)));
  acquisition::FinalistSearch search;
  core::AcquisitionCounts counts;
  for (auto _ : state) {
    counts = {};
    acquisition::WorkBudget budget(kUnlimited);
    search.start(room.views(), kDiameter_m);
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
