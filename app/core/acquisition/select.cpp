#include "app/core/acquisition/select.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "app/core/acquisition/assignment_tree.h"
#include "app/core/acquisition/candidate_grid.h"
#include "app/core/acquisition/edge_table.h"

namespace dottrack::acquisition {
namespace {

// The bounds tried one after another, as parts of the largest score.
constexpr std::array<double, 2> kBoundSteps = {1.0 / 32.0, 1.0};

// Partial sums are added in another order than match_score adds: ties, even at a score of nothing,
// must not fall to rounding.
constexpr double kRounding = 1.0 + 1e-9;
constexpr double kRounding_m2 = 1e-18;

// Neighbours made into options before the budget is asked again.
constexpr std::size_t kSlice = 64;

// Work units, of about ten nanoseconds.
constexpr std::uint64_t kTableUnits = 20;
constexpr std::uint64_t kPlantUnits = 5;
constexpr std::uint64_t kScoreUnits = 20;
constexpr std::uint64_t kUprightUnits = 200;

double squared(double v) {
  return v * v;
}

}  // namespace

// What is to be done next. A bound, an anchor dot, an anchor candidate, its options and the
// assignments with it are loops, one inside the other, that can be left and entered anywhere.
enum class Stage : std::uint8_t { bound, anchor_dot, anchor, options, assignments, ended };

struct Selector::Search {
  const TargetShape* shape = nullptr;
  std::span<const DotCandidate> candidates;
  SelectLimits limits;

  Stage stage = Stage::ended;
  SelectStatus status = SelectStatus::none;
  std::size_t bound_step = 0;      // the next one
  std::size_t anchors_before = 0;  // dots that have been the anchor: left out from now on
  std::size_t place = 0;           // of the next anchor in the grid
  std::size_t neighbour = 0;       // the next one to become an option
  double anchor_cost_m2 = 0.0;

  double bound_m2 = 0.0;
  double table_limit_m2 = 0.0;
  bool found = false;
  bool saw_upside_down = false;
  Selection best;

  CandidateGrid grid;
  EdgeTable table;
  Neighbours neighbours;
  AssignmentTree tree;

  // What a partial score may be at most, rounding included.
  double limit_m2() const { return bound_m2 * kRounding + kRounding_m2; }
  std::size_t anchor_dot() const { return shape->anchors[anchors_before]; }
  std::uint16_t anchor() const { return grid.candidate(place); }

  void step(WorkBudget& budget);
  void next_bound(WorkBudget& budget);
  void next_anchor_dot(WorkBudget& budget);
  void build_table(WorkBudget& budget);
  void next_anchor(WorkBudget& budget);
  void leave_anchor();
  void make_options(WorkBudget& budget);
  void walk(WorkBudget& budget);
  void judge(const Assignment& assignment, WorkBudget& budget);
};

void Selector::Search::step(WorkBudget& budget) {
  switch (stage) {
    case Stage::bound:
      return next_bound(budget);
    case Stage::anchor_dot:
      return next_anchor_dot(budget);
    case Stage::anchor:
      return next_anchor(budget);
    case Stage::options:
      return make_options(budget);
    case Stage::assignments:
      return walk(budget);
    case Stage::ended:
      return;
  }
}

void Selector::Search::next_bound(WorkBudget& budget) {
  if (found || bound_step == kBoundSteps.size()) {
    status = found             ? SelectStatus::found
             : saw_upside_down ? SelectStatus::only_upside_down
                               : SelectStatus::none;
    stage = Stage::ended;
    return;
  }
  bound_m2 = kBoundSteps[bound_step++] * limits.max_score_m2;
  const double tolerance_m = std::sqrt(limit_m2()) * kRounding;
  const auto diameters = std::span(shape->diameter_m).first(shape->dots);
  const auto& edges_m = shape->distance_m[shape->anchors[0]];
  grid.build(candidates, *std::min_element(diameters.begin(), diameters.end()) - tolerance_m,
             *std::max_element(diameters.begin(), diameters.end()) + tolerance_m,
             *std::max_element(edges_m.begin(), edges_m.end()) + tolerance_m);
  budget.spend(1 + candidates.size());
  anchors_before = 0;
  stage = Stage::anchor_dot;
}

void Selector::Search::next_anchor_dot(WorkBudget& budget) {
  if (anchors_before + limits.dots > shape->dots) {
    stage = Stage::bound;
    return;
  }
  build_table(budget);
  place = 0;
  stage = Stage::anchor;
}

// Of the edges from the anchor dot to those that have not been the anchor.
void Selector::Search::build_table(WorkBudget& budget) {
  DotSet ends = 0;
  for (std::size_t i = anchors_before + 1; i < shape->dots; ++i) {
    ends |= dot_bit(shape->anchors[i]);
  }
  table_limit_m2 = limit_m2();
  table.build(*shape, anchor_dot(), ends,
              std::sqrt(table_limit_m2) * kRounding + grid.rounding_m());
  budget.spend(kTableUnits);
}

// Goes through the candidates to the next that has neighbours enough to be the anchor.
void Selector::Search::next_anchor(WorkBudget& budget) {
  const double diameter_m = shape->diameter_m[anchor_dot()];
  const std::size_t enough = limits.dots - 1;
  for (; place < grid.size() && !budget.exhausted(); ++place) {
    anchor_cost_m2 = squared(candidates[anchor()].diameter_m - diameter_m);
    budget.spend(1);
    if (!(anchor_cost_m2 <= limit_m2())) continue;
    if (limit_m2() < table_limit_m2) build_table(budget);
    grid.neighbours(place, table, neighbours);
    budget.spend(2 + neighbours.looked / 8 + neighbours.size / 4);
    if (neighbours.size < enough ||
        static_cast<std::size_t>(std::popcount(neighbours.dots)) < enough) {
      continue;
    }
    tree.set_anchor(anchor_dot(), anchor(), anchor_cost_m2);
    neighbour = 0;
    stage = Stage::options;
    return;
  }
  if (place < grid.size()) return;
  ++anchors_before;
  stage = Stage::anchor_dot;
}

void Selector::Search::make_options(WorkBudget& budget) {
  const auto& edges_m = shape->distance_m[anchor_dot()];
  const Eigen::Vector3d& origin_m = candidates[anchor()].position_m;
  const double spare_m2 = limit_m2() - anchor_cost_m2;
  const std::size_t end = std::min(neighbours.size, neighbour + kSlice);
  budget.spend(2 * (end - neighbour));
  for (; neighbour < end; ++neighbour) {
    const Neighbour& near = neighbours.list[neighbour];
    const std::uint16_t c = grid.candidate(near.place);
    const double distance_m = (candidates[c].position_m - origin_m).norm();
    for (unsigned dots = near.dots; dots != 0; dots &= dots - 1U) {
      const auto dot = static_cast<std::size_t>(std::countr_zero(dots));
      const double cost_m2 = squared(distance_m - edges_m[dot]) +
                             squared(candidates[c].diameter_m - shape->diameter_m[dot]);
      if (cost_m2 <= spare_m2) tree.add(dot, {c, cost_m2});
    }
  }
  if (neighbour < neighbours.size) return;
  budget.spend(kPlantUnits);
  if (tree.plant(limit_m2())) {
    stage = Stage::assignments;
  } else {
    leave_anchor();
  }
}

void Selector::Search::leave_anchor() {
  ++place;
  stage = Stage::anchor;
}

void Selector::Search::walk(WorkBudget& budget) {
  switch (tree.walk(limit_m2(), budget)) {
    case AssignmentTree::Step::leaf:
      return judge(tree.assignment(), budget);
    case AssignmentTree::Step::ended:
      return leave_anchor();
    case AssignmentTree::Step::work_budget:
      return;
  }
}

void Selector::Search::judge(const Assignment& assignment, WorkBudget& budget) {
  budget.spend(kScoreUnits);
  const double score_m2 = match_score(*shape, candidates, assignment);
  if (!(score_m2 <= bound_m2)) return;
  if (limits.excluded != nullptr &&
      std::equal(assignment.begin(), assignment.begin() + static_cast<std::ptrdiff_t>(shape->dots),
                 limits.excluded->begin())) {
    return;
  }
  const bool first = !found || score_m2 < best.score_m2 || assignment < best.assignment;
  if (!first || !passes_variance_test(*shape, candidates, assignment)) return;
  budget.spend(kUprightUnits);
  if (!passes_upright_test(*shape, candidates, assignment)) {
    saw_upside_down = true;
    return;
  }
  found = true;
  best = {assignment, score_m2, static_cast<std::uint8_t>(limits.dots)};
  bound_m2 = score_m2;
}

Selector::Selector() : search_(std::make_unique<Search>()) {}
Selector::~Selector() = default;

std::size_t Selector::footprint_bytes() {
  return sizeof(Search);
}

void Selector::start(const TargetShape& shape, std::span<const DotCandidate> candidates,
                     const SelectLimits& limits) {
  Search& search = *search_;
  search.shape = &shape;
  search.candidates = candidates.first(std::min(candidates.size(), core::kMaxFinalists));
  search.limits = limits;
  search.found = false;
  search.saw_upside_down = false;
  search.bound_step = 0;
  search.status = SelectStatus::none;
  const bool possible = limits.dots >= core::kMinDots && limits.dots <= shape.dots &&
                        limits.dots <= search.candidates.size() && limits.max_score_m2 >= 0.0;
  search.stage = possible ? Stage::bound : Stage::ended;
  if (possible) search.tree.begin(shape, search.candidates, limits.dots);
}

SelectStatus Selector::advance(WorkBudget& budget, Selection& selection) {
  Search& search = *search_;
  while (search.stage != Stage::ended) {
    if (budget.exhausted()) return SelectStatus::work_budget;
    search.step(budget);
  }
  if (search.status == SelectStatus::found) selection = search.best;
  return search.status;
}

}  // namespace dottrack::acquisition
