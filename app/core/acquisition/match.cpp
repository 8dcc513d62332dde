#include "app/core/acquisition/match.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/core/geometry/crossover.h"

namespace dottrack::acquisition {
namespace {

using estimation::Sighting;

bool within(double range_m, const core::Camera& camera) {
  return range_m >= camera.distance_min_m && range_m <= camera.distance_max_m;
}

void count(PairGate gate, core::AcquisitionCounts& counts) {
  ++counts.pairs_tested;
  switch (gate) {
    case PairGate::accepted:
      ++counts.pairs_accepted;
      break;
    case PairGate::collinear:
      ++counts.rejected_collinear;
      break;
    case PairGate::behind:
      ++counts.rejected_behind;
      break;
    case PairGate::distance:
      ++counts.rejected_distance;
      break;
    case PairGate::miss:
      ++counts.rejected_miss;
      break;
    case PairGate::size:
      ++counts.rejected_size;
      break;
    case PairGate::reprojection:
      ++counts.rejected_reprojection;
      break;
  }
}

// Largest angle between the planes of two rays that pass within max_miss of each other, when the
// first is crossed no nearer than near_m from its camera.
double plane_tolerance(double sine_to_baseline, double near_m, double max_miss_m) {
  const double rho = near_m * sine_to_baseline;
  return max_miss_m < rho ? std::asin(max_miss_m / rho) : std::numbers::pi;
}

// A point in front of both cameras: half way along their middle rays.
Eigen::Vector3d middle_of_scene(const CameraView& a, const CameraView& b) {
  const auto middle = [](const CameraView& view) -> Eigen::Vector3d {
    const geometry::Ray& ray = view.sightings[view.sightings.size() / 2].line.ray;
    return ray.origin +
           0.5 * (view.camera->distance_min_m + view.camera->distance_max_m) * ray.direction;
  };
  return 0.5 * (middle(a) + middle(b));
}

}  // namespace

PairGate test_pair(const CameraView& a, std::size_t sighting_a, const CameraView& b,
                   std::size_t sighting_b, double max_miss_m, CandidatePair& pair) {
  const Sighting& in_a = a.sightings[sighting_a];
  const Sighting& in_b = b.sightings[sighting_b];
  geometry::Crossover cross;
  switch (geometry::closest_crossover(in_a.line.ray, in_b.line.ray, cross)) {
    case geometry::CrossoverStatus::collinear:
      return PairGate::collinear;
    case geometry::CrossoverStatus::behind:
      return PairGate::behind;
    case geometry::CrossoverStatus::ok:
      break;
  }
  if (!within(cross.range_a_m, *a.camera) || !within(cross.range_b_m, *b.camera)) {
    return PairGate::distance;
  }
  if (cross.miss_m > max_miss_m) return PairGate::miss;
  if (!in_a.window.contains(cross.range_a_m) || !in_b.window.contains(cross.range_b_m)) {
    return PairGate::size;
  }
  if (!in_a.box_contains(in_a.pixel_of(cross.point_m)) ||
      !in_b.box_contains(in_b.pixel_of(cross.point_m))) {
    return PairGate::reprojection;
  }
  pair.sighting = {static_cast<std::uint16_t>(sighting_a), static_cast<std::uint16_t>(sighting_b)};
  pair.point_m = cross.point_m;
  return PairGate::accepted;
}

void Matcher::start() {}

bool Matcher::match(std::span<const CameraView> views, std::size_t a, std::size_t b,
                    double max_miss_m, CandidatePairs& pairs, core::AcquisitionCounts& counts,
                    WorkBudget& budget, std::size_t& next) {
  const CameraView& view_a = views[a];
  const CameraView& view_b = views[b];
  if (view_a.sightings.empty() || view_b.sightings.empty()) return true;
  const PlanePencil pencil(geometry::centre(view_a.camera->model),
                           geometry::centre(view_b.camera->model), middle_of_scene(view_a, view_b));
  if (!pencil.has_baseline()) return true;
  index_.build(pencil, view_b.sightings);
  const double reach_m = max_miss_m + view_a.origin_offset_m + view_b.origin_offset_m;

  CandidatePair pair;
  pair.camera = {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)};
  for (; next < view_a.sightings.size(); ++next) {
    if (budget.exhausted()) return false;
    const Sighting& sighting = view_a.sightings[next];
    const Eigen::Vector3d& direction = sighting.line.ray.direction;
    const double tolerance =
        plane_tolerance(pencil.sine_to_baseline(direction), sighting.window.near_m, reach_m);
    const auto candidates = index_.near(pencil.angle(direction), tolerance);
    budget.spend(1 + candidates.size());
    for (const std::uint16_t j : candidates) {
      const PairGate gate = test_pair(view_a, next, view_b, j, max_miss_m, pair);
      count(gate, counts);
      if (gate == PairGate::accepted && !try_push_back(pairs, pair)) ++counts.overflow;
    }
  }
  return true;
}

void Matcher::match(std::span<const CameraView> views, std::size_t a, std::size_t b,
                    double max_miss_m, CandidatePairs& pairs, core::AcquisitionCounts& counts,
                    WorkBudget& budget) {
  start();
  std::size_t next = 0;
  match(views, a, b, max_miss_m, pairs, counts, budget, next);
}

}  // namespace dottrack::acquisition
