#include "app/core/acquisition/match.h"

#include "app/core/geometry/crossover.h"

namespace dottrack::acquisition {
namespace {

using estimation::Sighting;

// What the work costs, in units of about 10 ns.
constexpr std::size_t kRaysPreparedInAUnit = 2;
constexpr std::uint32_t kLooksInAUnit = 16;
constexpr std::uint32_t kUnitsToTest = 3;

bool within(double range_m, const core::Camera& camera) {
  return range_m >= camera.distance_min_m && range_m <= camera.distance_max_m;
}

// Where the crossover projects to is in the sighting's box and close to its centre.
bool agrees(const Sighting& sighting, const Eigen::Vector3d& point_m, double max_residual_px) {
  const Eigen::Vector2d pixel = sighting.pixel_of(point_m);
  return sighting.box_contains(pixel) &&
         (pixel - sighting.pixel).squaredNorm() <= max_residual_px * max_residual_px;
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

// test_pair, and whether the point is as close to both sightings.
PairGate test(const CameraView& a, std::size_t sighting_a, const CameraView& b,
              std::size_t sighting_b, double max_miss_m, double max_residual_px,
              CandidatePair& pair) {
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
  if (!agrees(in_a, cross.point_m, max_residual_px) ||
      !agrees(in_b, cross.point_m, max_residual_px)) {
    return PairGate::reprojection;
  }
  pair.sighting = {static_cast<std::uint16_t>(sighting_a), static_cast<std::uint16_t>(sighting_b)};
  pair.point_m = cross.point_m;
  return PairGate::accepted;
}

}  // namespace

PairGate test_pair(const CameraView& a, std::size_t sighting_a, const CameraView& b,
                   std::size_t sighting_b, double max_miss_m, CandidatePair& pair) {
  return test(a, sighting_a, b, sighting_b, max_miss_m, std::numeric_limits<double>::infinity(),
              pair);
}

void Matcher::start(double max_residual_px) {
  prepared_ = {};
  max_residual_px_ = max_residual_px;
}

const RayArrays& Matcher::rays(std::span<const CameraView> views, std::size_t camera) {
  if (!prepared_.contains(camera)) {
    fill(rays_[camera], *views[camera].camera, views[camera].sightings, max_residual_px_);
    prepared_.insert(camera);
  }
  return rays_[camera];
}

bool Matcher::match(std::span<const CameraView> views, std::size_t a, std::size_t b,
                    double max_miss_m, CandidatePairs& pairs, core::AcquisitionCounts& counts,
                    WorkBudget& budget, std::size_t& next) {
  const CameraView& view_a = views[a];
  const CameraView& view_b = views[b];
  const std::size_t rows = view_a.sightings.size();
  if (next >= rows || view_b.sightings.empty()) return true;
  if (budget.exhausted()) return false;
  budget.spend((rows + view_b.sightings.size()) / kRaysPreparedInAUnit);
  if (!filter_.start(rays(views, a), rays(views, b), max_miss_m)) return true;

  CandidatePair pair;
  pair.camera = {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)};
  while (next < rows) {
    for (const PairFilter::Row& row : filter_.rows(next)) {
      budget.spend(1U + row.looked_at / kLooksInAUnit + kUnitsToTest * row.hits);
      for (const std::uint16_t j : filter_.hits(row)) {
        const PairGate gate = test(view_a, next, view_b, j, max_miss_m, max_residual_px_, pair);
        count(gate, counts);
        if (gate == PairGate::accepted && !try_push_back(pairs, pair)) ++counts.overflow;
      }
      ++next;
      if (budget.exhausted()) return next == rows;
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
