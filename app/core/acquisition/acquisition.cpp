#include "app/core/acquisition/acquisition.h"

#include <algorithm>
#include <cmath>

#include "app/core/acquisition/ellipse_evidence.h"
#include "app/core/acquisition/finalist_search.h"
#include "app/core/acquisition/sightings.h"
#include "app/core/estimation/locate.h"
#include "app/core/estimation/same_place.h"

namespace dottrack::acquisition {
namespace {

// Lines of sight cross by chance in two views often, in more hardly ever: the target is looked for
// among the finalists of many views first, then of fewer.
constexpr std::array<int, 4> kViewLayers = {6, 4, 3, 2};

// Three dots of a larger target are the last resort, and only among finalists of the first so many
// layers: of three that two cameras each see, most are chance.
constexpr std::size_t kLayersOfLastResort = 3;

// A later candidate takes the place of an earlier one, of more dots or more views, only when it is
// clearly less probable to be false.
constexpr double kClearlyLess = 0.5;

// Work to make a line of sight of a region, and to weigh one dot of a candidate, by finalist: each
// may be clutter near it.
constexpr std::uint64_t kUnitsToSight = 3;
constexpr std::uint64_t kUnitsToWeigh = 1;
// At the most both fit into a tick's budget of 200,000.
static_assert(kUnitsToSight * core::kMaxRegions * kMaxCameras <= 50'000);
static_assert(kUnitsToWeigh * core::kMaxFinalists * core::kMaxDots <= 150'000);

double sum_of_squared_edge_errors(const TargetShape& shape, std::span<const Witness> witnesses) {
  double sum = 0.0;
  for (std::size_t i = 0; i < witnesses.size(); ++i) {
    for (std::size_t j = i + 1; j < witnesses.size(); ++j) {
      const double edge = (witnesses[i].position_m - witnesses[j].position_m).norm();
      const double off = edge - shape.distance_m[witnesses[i].dot][witnesses[j].dot];
      sum += off * off;
    }
  }
  return sum;
}

double mean_variance(std::span<const Witness> witnesses) {
  double sum = 0.0;
  for (const Witness& witness : witnesses) sum += witness.covariance_m2.trace() / 3.0;
  return sum / static_cast<double>(witnesses.size());
}

}  // namespace

struct Acquisition::Memory {
  std::array<CameraView, kMaxCameras> views;
  FinalistSearch search;
  Selector selector;
  StaticVector<DotCandidate, core::kMaxFinalists> candidates;
  StaticVector<std::uint16_t, core::kMaxFinalists> origin;  // a candidate's index among finalists
  Selection selection;                                      // of finalists
  Assignment given{};  // the same dots as candidates of their own, in their present order
  CandidateLock lock;  // what the selection makes
  CandidateLock rival;
  AcquisitionResult result;

  void clear_candidates() {
    candidates.clear();
    origin.clear();
  }
  void add_candidate(std::size_t finalist) {
    const Finalist& f = search.finalists()[finalist];
    candidates.push_back({f.position_m, f.diameter_m});
    origin.push_back(static_cast<std::uint16_t>(finalist));
  }
  // From indices of candidates to indices of finalists.
  Selection to_finalists(Selection selected) const {
    for (std::uint16_t& index : selected.assignment) {
      if (index != kNoCandidate) index = origin[index];
    }
    return selected;
  }
};

Acquisition::Acquisition(const core::Rig& rig, std::span<const geometry::Optics> optics)
    : rig_(&rig),
      optics_(optics),
      shape_(make_target_shape(rig.target)),
      memory_(std::make_unique<Memory>()) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) memory_->views[i].camera = &rig.cameras[i];
  // While nothing is seen: what the cameras share is measured now and not in the first search.
  memory_->search.start({memory_->views.data(), rig.cameras.size()}, 0.0);
}

Acquisition::~Acquisition() = default;

std::size_t Acquisition::footprint_bytes() const {
  return sizeof(*this) + sizeof(Memory) + Selector::footprint_bytes() +
         memory_->search.footprint_bytes();
}

std::size_t Acquisition::sightings(std::size_t camera) const {
  return memory_->views[camera].sightings.size();
}

std::size_t Acquisition::most_dots() const {
  return last_resort_ ? core::kMinDots : shape_.dots;
}

std::size_t Acquisition::fewest_dots() const {
  return std::min(shape_.dots, last_resort_ ? core::kMinDots : core::kMinPartialDots);
}

void Acquisition::start(std::span<const image::Regions* const> regions, WorkBudget& budget) {
  const std::span<CameraView> views(memory_->views.data(), rig_->cameras.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    take_sightings(rig_->target, optics_[i], regions[i], views[i]);
    if (regions[i] != nullptr) budget.spend(kUnitsToSight * regions[i]->size());
  }
  const auto seeing = std::count_if(views.begin(), views.end(),
                                    [](const CameraView& v) { return !v.sightings.empty(); });
  memory_->result.reason = core::Reason::too_few_regions;
  memory_->result.counts = {};
  has_candidate_ = false;
  memory_->search.start(views, core::largest_dot_diameter_m(rig_->target));
  layer_ = 0;
  last_resort_ = false;
  stage_ = seeing >= 2 ? Stage::finalists : Stage::ended;
}

bool Acquisition::go_on(WorkBudget& budget) {
  core::AcquisitionCounts& counts = memory_->result.counts;
  if (busy()) ++counts.ticks;
  while (busy() && step(budget)) {
  }
  counts.work_units = budget.spent();
  return !busy();
}

void Acquisition::stop() {
  if (busy()) note(core::Reason::work_budget);
  stage_ = Stage::ended;
}

const AcquisitionResult& Acquisition::result() const {
  return memory_->result;
}

bool Acquisition::step(WorkBudget& budget) {
  switch (stage_) {
    case Stage::finalists:
      return find_finalists(budget);
    case Stage::selection:
      return select(budget);
    case Stage::other_labels:
    case Stage::other_places:
      return find_rival(budget);
    case Stage::ended:
      break;
  }
  return false;
}

// Of all reasons on the way, the one that the search came furthest with: they are numbered so.
void Acquisition::note(core::Reason reason) {
  core::Reason& kept = memory_->result.reason;
  if (!has_candidate_) kept = std::max(kept, reason);
}

// 3.1.3
bool Acquisition::find_finalists(WorkBudget& budget) {
  core::AcquisitionCounts& counts = memory_->result.counts;
  if (!memory_->search.advance(kViewLayers[layer_], budget, counts)) return false;
  dots_ = most_dots();
  begin_selection();
  return true;
}

// 3.1.4
void Acquisition::begin_selection() {
  Memory& m = *memory_;
  m.clear_candidates();
  for (std::size_t i = 0; i < m.search.finalists().size(); ++i) {
    if (m.search.finalists()[i].cameras.size() >= kViewLayers[layer_]) m.add_candidate(i);
  }
  while (dots_ > m.candidates.size() && dots_ > fewest_dots()) --dots_;
  if (dots_ > m.candidates.size()) {
    note(core::Reason::too_few_finalists);
    go_on_with_fewer();
    return;
  }
  m.selector.start(shape_, as_span(m.candidates),
                   {largest_score(shape_, rig_->limits.max_rms_residual_m, dots_), dots_});
  stage_ = Stage::selection;
}

bool Acquisition::select(WorkBudget& budget) {
  Memory& m = *memory_;
  Selection selected;
  const SelectStatus status = m.selector.advance(budget, selected);
  if (status == SelectStatus::work_budget) return false;
  if (status == SelectStatus::found && !budget.fits(units_to_weigh(selected))) return false;
  core::Reason reason = status == SelectStatus::only_upside_down ? core::Reason::upside_down
                                                                 : core::Reason::no_matching_subset;
  if (status == SelectStatus::found) {
    m.selection = m.to_finalists(selected);
    reason = make_lock(m.selection, budget, m.lock);
  }
  if (reason == core::Reason::none) {
    begin_other_labels();
  } else {
    note(reason);
    go_on_with_fewer();
  }
  return true;
}

// Other parts of the target among the same finalists, then finalists of fewer views, and three dots
// at last.
void Acquisition::go_on_with_fewer() {
  if (dots_ > fewest_dots() && memory_->candidates.size() >= fewest_dots()) {
    --dots_;
    begin_selection();
    return;
  }
  ++layer_;
  if (!last_resort_ && layer_ == kViewLayers.size() && shape_.dots > core::kMinDots) {
    last_resort_ = true;
    layer_ = 0;
  }
  const std::size_t layers = last_resort_ ? kLayersOfLastResort : kViewLayers.size();
  stage_ = layer_ < layers ? Stage::finalists : Stage::ended;
}

// The score up to which another explanation is worth weighing: beyond it, it is less probable than
// the limit on false locks by its misfit alone.
double Acquisition::rival_score() const {
  const Memory& m = *memory_;
  const auto n = static_cast<double>(m.lock.witnesses.size());
  const std::span<const Witness> witnesses = as_span(m.lock.witnesses);
  const double variance = 2.0 * sum_of_squared_edge_errors(shape_, witnesses) / (n * (n - 1.0)) +
                          mean_variance(witnesses);
  const double margin = -2.0 * std::log(rig_->limits.max_false_lock_probability);
  return std::min(m.selection.score_m2 + margin * n * variance,
                  largest_score(shape_, rig_->limits.max_rms_residual_m, m.selection.dots));
}

// The same finalists, labelled otherwise: a symmetric target, turned round.
void Acquisition::begin_other_labels() {
  Memory& m = *memory_;
  m.clear_candidates();
  m.given.fill(kNoCandidate);
  for (std::size_t dot = 0; dot < shape_.dots; ++dot) {
    if (m.selection.assignment[dot] == kNoCandidate) continue;
    m.given[dot] = static_cast<std::uint16_t>(m.candidates.size());
    m.add_candidate(m.selection.assignment[dot]);
  }
  m.selector.start(shape_, as_span(m.candidates), {rival_score(), m.selection.dots, &m.given});
  stage_ = Stage::other_labels;
}

// Other finalists: another thing that looks like the target.
void Acquisition::begin_other_places() {
  Memory& m = *memory_;
  const double reach_m = core::largest_dot_diameter_m(rig_->target);
  const auto belongs = [&](const Finalist& finalist) {
    return std::any_of(m.lock.witnesses.begin(), m.lock.witnesses.end(), [&](const Witness& w) {
      return (w.position_m - finalist.position_m).squaredNorm() < reach_m * reach_m;
    });
  };
  m.clear_candidates();
  for (std::size_t i = 0; i < m.search.finalists().size(); ++i) {
    const Finalist& finalist = m.search.finalists()[i];
    if (finalist.cameras.size() >= kViewLayers[layer_] && !belongs(finalist)) m.add_candidate(i);
  }
  if (m.candidates.size() < m.selection.dots) {
    judge();
    return;
  }
  m.selector.start(shape_, as_span(m.candidates), {rival_score(), m.selection.dots});
  stage_ = Stage::other_places;
}

bool Acquisition::find_rival(WorkBudget& budget) {
  Memory& m = *memory_;
  Selection selected;
  const SelectStatus status = m.selector.advance(budget, selected);
  if (status == SelectStatus::work_budget) return false;
  if (status == SelectStatus::found && !budget.fits(units_to_weigh(selected))) return false;
  if (status == SelectStatus::found) {
    const Selection rival = m.to_finalists(selected);
    if (make_lock(rival, budget, m.rival) == core::Reason::none) add_rival(m.rival);
  }
  if (stage_ == Stage::other_labels) {
    begin_other_places();
  } else {
    judge();
  }
  return true;
}

void Acquisition::add_rival(const CandidateLock& rival) {
  CandidateLock& lock = memory_->lock;
  if (estimation::same_place(rig_->target, lock.pose, rival.pose)) return;
  lock.rivals.push_back(rival_log_odds(lock, rival));
}

// Keeps the better one of this candidate and the one before, each the other's rival.
void Acquisition::judge() {
  Memory& m = *memory_;
  AcquisitionResult& result = m.result;
  if (has_candidate_) add_rival(result.candidate);
  const double p = false_lock_probability(m.lock.log_odds, as_span(m.lock.rivals));
  if (!has_candidate_ || p < kClearlyLess * result.counts.false_lock_probability) {
    has_candidate_ = true;
    result.candidate = m.lock;
    result.counts.false_lock_probability = p;
    result.counts.min_views = static_cast<std::uint8_t>(kViewLayers[layer_]);
    result.counts.dots_matched = m.selection.dots;
    const double limit = rig_->limits.max_false_lock_probability;
    result.reason = p > limit && false_lock_probability(m.lock.log_odds, {}) <= limit
                        ? core::Reason::ambiguous
                        : core::Reason::none;
    if (p <= limit) {
      stage_ = Stage::ended;
      return;
    }
  }
  go_on_with_fewer();
}

std::uint64_t Acquisition::units_to_weigh(const Selection& selection) const {
  return kUnitsToWeigh * memory_->search.finalists().size() * selection.dots;
}

// 3.1.5
core::Reason Acquisition::make_lock(const Selection& selection, WorkBudget& budget,
                                    CandidateLock& lock) const {
  const std::span<const Finalist> finalists = as_span(memory_->search.finalists());
  lock.rivals.clear();
  lock.witnesses = witnesses_of(finalists, selection);
  StaticVector<estimation::LocatedDot, core::kMaxDots> dots;
  for (const Witness& witness : lock.witnesses) {
    dots.push_back(
        estimation::triangulated_dot(witness.dot, witness.position_m, witness.covariance_m2));
  }
  const core::Reason reason = estimation::reason_of(
      estimation::locate(rig_->target, as_span(dots), rig_->limits.max_rms_residual_m, lock.pose));
  if (reason != core::Reason::none) return reason;
  budget.spend(units_to_weigh(selection));
  lock.log_odds =
      log_odds_of_lock(lock.pose, as_span(lock.witnesses)) + ellipse_evidence(selection, lock.pose);
  return core::Reason::none;
}

double Acquisition::log_odds_of_lock(const core::Pose& pose,
                                     std::span<const Witness> witnesses) const {
  return log_odds_of(rig_->target, witnesses, pose, as_span(memory_->search.finalists()),
                     rig_->limits.max_rms_residual_m);
}

// 3.3: how the regions look beside what dots with these normals look like.
double Acquisition::ellipse_evidence(const Selection& selection, const core::Pose& pose) const {
  double sum = 0.0;
  for (std::size_t dot = 0; dot < shape_.dots; ++dot) {
    if (selection.assignment[dot] == kNoCandidate) continue;
    const Finalist& finalist = memory_->search.finalists()[selection.assignment[dot]];
    sum += ellipse_log_odds_of_dot({memory_->views.data(), rig_->cameras.size()}, finalist,
                                   rig_->target.dots[dot], pose);
  }
  return sum;
}

}  // namespace dottrack::acquisition
