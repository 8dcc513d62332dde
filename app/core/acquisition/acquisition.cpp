#include "app/core/acquisition/acquisition.h"

#include <algorithm>

#include "app/core/acquisition/chance.h"
#include "app/core/acquisition/finalist_search.h"
#include "app/core/acquisition/match.h"

namespace dottrack::acquisition {
namespace {

// Work units in one tick; see WorkBudget.
constexpr std::uint64_t kWorkUnits = 1'500'000;

// Lines of sight cross by chance in two views often, in more hardly ever: the target is looked for
// among the finalists of many views first, then of fewer.
constexpr std::array<int, 3> kViewLayers = {4, 3, 2};

// A lock is refused when clutter would offer more matches as good as it by chance.
constexpr double kMaxChanceMatches = 1e-3;

// Two labellings are told apart when their scores differ by this many times the squared fit: the
// worse one is then less likely by exp(-7), a thousandth.
constexpr double kRivalMargin = 14.0;

estimation::DiameterRange diameters(const core::Target& target) {
  return {core::smallest_dot_diameter_m(target), core::largest_dot_diameter_m(target)};
}

std::size_t cameras_with_sightings(std::span<const CameraView> views) {
  return static_cast<std::size_t>(std::count_if(
      views.begin(), views.end(), [](const CameraView& v) { return !v.sightings.empty(); }));
}

core::Reason reason_of(SelectStatus status) {
  switch (status) {
    case SelectStatus::found:
      return core::Reason::none;
    case SelectStatus::none:
      return core::Reason::no_matching_subset;
    case SelectStatus::only_upside_down:
      return core::Reason::upside_down;
    case SelectStatus::work_budget:
      return core::Reason::work_budget;
  }
  return core::Reason::no_matching_subset;
}

}  // namespace

image::RegionGate acquisition_gate(const core::Camera& camera, const geometry::Optics& optics,
                                   const core::Target& target) {
  const estimation::DiameterRange dots = diameters(target);
  const geometry::AngularScale& scale = optics.extremes();
  return estimation::dot_gate(
      camera, {estimation::expected_semi_major(dots, camera.distance_max_m, scale).min_px,
               estimation::expected_semi_major(dots, camera.distance_min_m, scale).max_px});
}

struct Acquisition::Memory {
  std::array<CameraView, kMaxCameras> views;
  FinalistSearch search;
  StaticVector<DotCandidate, core::kMaxFinalists> candidates;
  StaticVector<std::uint16_t, core::kMaxFinalists> origin;  // a candidate's index among finalists
  Selector selector;
};

Acquisition::Acquisition(const core::Rig& rig, std::span<const geometry::Optics> optics)
    : rig_(&rig),
      optics_(optics),
      shape_(make_target_shape(rig.target)),
      memory_(std::make_unique<Memory>()) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) memory_->views[i].camera = &rig.cameras[i];
}

Acquisition::~Acquisition() = default;

std::size_t Acquisition::footprint_bytes() const {
  return sizeof(*this) + sizeof(Memory) + memory_->search.footprint_bytes() +
         Selector::footprint_bytes();
}

void Acquisition::take_sightings(std::span<const image::Regions* const> regions) {
  const estimation::DiameterRange dots = diameters(rig_->target);
  for (std::size_t i = 0; i < rig_->cameras.size(); ++i) {
    CameraView& view = memory_->views[i];
    view.sightings.clear();
    view.origin_offset_m = 0.0;
    if (regions[i] == nullptr) continue;
    const Eigen::Vector3d& centre = geometry::centre(view.camera->model);
    for (std::size_t r = 0; r < regions[i]->size(); ++r) {
      const image::Region& region = (*regions[i])[r];
      estimation::Sighting sighting;
      if (region.touches_border ||
          !estimation::make_sighting(*view.camera, optics_[i], dots, region, sighting)) {
        continue;
      }
      sighting.region = static_cast<std::uint16_t>(r);
      view.sightings.push_back(sighting);
      view.origin_offset_m =
          std::max(view.origin_offset_m, (sighting.line.ray.origin - centre).norm());
    }
  }
}

void Acquisition::match(core::AcquisitionCounts& counts, WorkBudget& budget) {
  const std::span<const CameraView> views(memory_->views.data(), rig_->cameras.size());
  memory_->search.start(views, core::largest_dot_diameter_m(rig_->target));
  memory_->search.advance(2, budget, counts);
}

core::Reason Acquisition::select(int min_views, WorkBudget& budget, Selection& selection) {
  const Finalists& finalists = memory_->search.finalists();
  auto& candidates = memory_->candidates;
  auto& origin = memory_->origin;
  candidates.clear();
  origin.clear();
  for (std::size_t i = 0; i < finalists.size(); ++i) {
    if (finalists[i].cameras.size() < min_views) continue;
    candidates.push_back({finalists[i].position_m, finalists[i].diameter_m});
    origin.push_back(static_cast<std::uint16_t>(i));
  }
  memory_->selector.start(
      shape_, as_span(candidates),
      {largest_score(shape_, rig_->limits.max_rms_residual_m, shape_.dots), shape_.dots});
  const SelectStatus status = memory_->selector.advance(budget, selection);
  if (status != SelectStatus::found) return reason_of(status);
  for (std::size_t k = 0; k < shape_.dots; ++k) {
    selection.assignment[k] = origin[selection.assignment[k]];
  }
  return core::Reason::none;
}

// Another labelling of the same dots is nearly as good: a symmetric target, turned round.
bool Acquisition::has_rival_labelling(const Selection& selection, WorkBudget& budget) {
  const Finalists& finalists = memory_->search.finalists();
  auto& candidates = memory_->candidates;
  candidates.clear();
  Assignment given;
  given.fill(kNoCandidate);
  for (std::size_t k = 0; k < shape_.dots; ++k) {
    const Finalist& finalist = finalists[selection.assignment[k]];
    candidates.push_back({finalist.position_m, finalist.diameter_m});
    given[k] = static_cast<std::uint16_t>(k);
  }
  const double fit_m = fit_of(shape_, as_span(finalists), selection);
  Selection rival;
  memory_->selector.start(shape_, as_span(candidates),
                          {selection.score_m2 + kRivalMargin * fit_m * fit_m, shape_.dots, &given});
  return memory_->selector.advance(budget, rival) == SelectStatus::found;
}

core::Reason Acquisition::judge(const Selection& selection, WorkBudget& budget,
                                AcquisitionResult& result) {
  const Finalists& finalists = memory_->search.finalists();
  result.counts.false_lock_probability =
      std::min(1.0, chance_matches(shape_, as_span(finalists), selection));
  if (result.counts.false_lock_probability > kMaxChanceMatches ||
      has_rival_labelling(selection, budget)) {
    return core::Reason::ambiguous;
  }
  StaticVector<estimation::LocatedDot, core::kMaxDots> dots;
  for (std::size_t k = 0; k < shape_.dots; ++k) {
    const Finalist& finalist = finalists[selection.assignment[k]];
    dots.push_back(estimation::triangulated_dot(k, finalist.position_m, finalist.covariance_m2));
  }
  return estimation::reason_of(estimation::locate(
      rig_->target, as_span(dots), rig_->limits.max_rms_residual_m, nullptr, result.pose));
}

core::Reason Acquisition::select_and_locate(WorkBudget& budget, AcquisitionResult& result) {
  core::Reason reason = core::Reason::no_matching_subset;
  for (const int min_views : kViewLayers) {
    Selection selection;
    reason = select(min_views, budget, selection);
    if (reason == core::Reason::none) reason = judge(selection, budget, result);
    if (reason == core::Reason::none || reason == core::Reason::work_budget) break;
  }
  return reason;
}

AcquisitionResult Acquisition::acquire(std::span<const image::Regions* const> regions) {
  AcquisitionResult result;
  WorkBudget budget(kWorkUnits);
  take_sightings(regions);
  const std::span<const CameraView> views(memory_->views.data(), rig_->cameras.size());
  if (cameras_with_sightings(views) >= 2) {
    match(result.counts, budget);
    if (budget.exhausted()) {
      result.reason = core::Reason::work_budget;
    } else if (result.counts.finalists < shape_.dots) {
      result.reason = core::Reason::too_few_finalists;
    } else {
      result.reason = select_and_locate(budget, result);
    }
  }
  result.counts.work_units = budget.spent();
  return result;
}

}  // namespace dottrack::acquisition
