#include "app/core/acquisition/select.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/base/static_vector.h"

namespace dottrack::acquisition {
namespace {

// The bounds tried one after another, as parts of the largest score.
constexpr std::array<double, 3> kBoundSteps = {1.0 / 64.0, 1.0 / 8.0, 1.0};

// Partial sums are added in another order than match_score adds: ties, even at a score of nothing,
// must not fall to rounding.
constexpr double kRounding = 1.0 + 1e-9;
constexpr double kRounding_m2 = 1e-18;

double squared(double v) {
  return v * v;
}

// A candidate for one dot beside the current anchor, with what it adds to the score by itself.
struct Option {
  std::uint16_t candidate = 0;
  double cost_m2 = 0.0;  // its diameter and its distance to the anchor
};

using Options = StaticVector<Option, core::kMaxFinalists>;

}  // namespace

struct Selector::Search {
  const TargetShape* shape = nullptr;
  std::span<const DotCandidate> candidates;
  WorkBudget* budget = nullptr;
  const Assignment* excluded = nullptr;

  std::array<Options, core::kMaxDots> options;             // by dot; the anchor's stays empty
  std::array<std::uint8_t, core::kMaxDots> order{};        // dots, fewest options first
  std::array<double, core::kMaxDots + 1> least_rest_m2{};  // least cost of dots order[k..]
  Assignment assignment{};
  double max_score_m2 = 0.0;
  double bound_m2 = 0.0;
  bool found = false;
  bool saw_upside_down = false;
  Selection best;

  // What a partial score may be at most, rounding included.
  double limit_m2() const { return bound_m2 * kRounding + kRounding_m2; }

  // The whole search below one bound; false when the budget ran out.
  bool run(double bound);
  void try_anchor(std::uint16_t candidate);
  bool collect_options(std::uint16_t anchor, double anchor_cost);
  void order_dots();
  void extend(std::size_t depth, double cost);
  double cost_beside_chosen(std::size_t depth, std::uint8_t dot, const Option& option,
                            double cost) const;
  bool taken(std::size_t depth, std::uint16_t candidate) const;
  void judge();
};

bool Selector::Search::run(double bound) {
  bound_m2 = bound;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!budget->spend(1 + candidates.size() / 8)) return false;
    try_anchor(static_cast<std::uint16_t>(c));
    if (budget->exhausted()) return false;
  }
  return true;
}

void Selector::Search::try_anchor(std::uint16_t candidate) {
  const double cost = squared(candidates[candidate].diameter_m - shape->diameter_m[shape->anchor]);
  if (cost > limit_m2() || !collect_options(candidate, cost)) return;
  order_dots();
  assignment[shape->anchor] = candidate;
  extend(0, cost);
}

// False when some dot has no candidate at its distance from the anchor.
bool Selector::Search::collect_options(std::uint16_t anchor, double anchor_cost) {
  for (std::size_t dot = 0; dot < shape->dots; ++dot) options[dot].clear();
  const auto& edges = shape->distance_m[shape->anchor];
  const double spare = limit_m2() - anchor_cost;
  const double tolerance = std::sqrt(spare);
  const double longest =
      *std::max_element(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(shape->dots));
  const double reach2 = squared(longest + tolerance);
  const Eigen::Vector3d& origin = candidates[anchor].position_m;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const double distance2 = (candidates[c].position_m - origin).squaredNorm();
    if (distance2 > reach2 || c == anchor) continue;
    const double distance = std::sqrt(distance2);
    for (std::size_t dot = 0; dot < shape->dots; ++dot) {
      const double off = std::abs(distance - edges[dot]);
      if (off > tolerance || dot == shape->anchor) continue;
      const double cost = off * off + squared(candidates[c].diameter_m - shape->diameter_m[dot]);
      if (cost <= spare) options[dot].push_back({static_cast<std::uint16_t>(c), cost});
    }
  }
  for (std::size_t dot = 0; dot < shape->dots; ++dot) {
    if (dot != shape->anchor && options[dot].empty()) return false;
  }
  return true;
}

void Selector::Search::order_dots() {
  std::size_t n = 0;
  for (std::size_t dot = 0; dot < shape->dots; ++dot) {
    if (dot != shape->anchor) order[n++] = static_cast<std::uint8_t>(dot);
  }
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n), [this](auto a, auto b) {
    const std::size_t size_a = options[a].size();
    const std::size_t size_b = options[b].size();
    return size_a != size_b ? size_a < size_b : a < b;
  });
  least_rest_m2[n] = 0.0;
  for (std::size_t k = n; k-- > 0;) {
    double least = std::numeric_limits<double>::infinity();
    for (const Option& option : options[order[k]]) least = std::min(least, option.cost_m2);
    least_rest_m2[k] = least_rest_m2[k + 1] + least;
  }
}

bool Selector::Search::taken(std::size_t depth, std::uint16_t candidate) const {
  for (std::size_t k = 0; k < depth; ++k) {
    if (assignment[order[k]] == candidate) return true;
  }
  return false;
}

// The partial score with this option added; stops adding once it exceeds the bound.
double Selector::Search::cost_beside_chosen(std::size_t depth, std::uint8_t dot,
                                            const Option& option, double cost) const {
  double total = cost + option.cost_m2;
  const double limit = limit_m2() - least_rest_m2[depth + 1];
  const Eigen::Vector3d& position = candidates[option.candidate].position_m;
  for (std::size_t k = 0; k < depth && total <= limit; ++k) {
    const std::uint8_t other = order[k];
    const double distance = (candidates[assignment[other]].position_m - position).norm();
    total += squared(distance - shape->distance_m[dot][other]);
  }
  return total <= limit ? total : std::numeric_limits<double>::infinity();
}

void Selector::Search::extend(std::size_t depth, double cost) {
  if (depth + 1 == shape->dots) {
    judge();
    return;
  }
  const std::uint8_t dot = order[depth];
  if (!budget->spend(options[dot].size())) return;
  for (const Option& option : options[dot]) {
    const double total = cost_beside_chosen(depth, dot, option, cost);
    if (total > limit_m2() || taken(depth, option.candidate)) continue;
    assignment[dot] = option.candidate;
    extend(depth + 1, total);
    if (budget->exhausted()) return;
  }
}

void Selector::Search::judge() {
  const double score = match_score(*shape, candidates, assignment);
  if (score > bound_m2 || (excluded != nullptr && assignment == *excluded)) return;
  const bool first =
      !found || score < best.score_m2 || (score == best.score_m2 && assignment < best.assignment);
  if (!first || !passes_variance_test(*shape, candidates, assignment)) return;
  budget->spend(100);
  if (!passes_upright_test(*shape, candidates, assignment)) {
    saw_upside_down = true;
    return;
  }
  found = true;
  best.assignment = assignment;
  best.score_m2 = score;
  best.dots = static_cast<std::uint8_t>(shape->dots);
  bound_m2 = score;
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
  search.excluded = limits.excluded;
  search.max_score_m2 = limits.max_score_m2;
  search.assignment.fill(kNoCandidate);
  search.found = false;
  search.saw_upside_down = false;
}

SelectStatus Selector::advance(WorkBudget& budget, Selection& selection) {
  Search& search = *search_;
  search.budget = &budget;
  if (search.candidates.size() < search.shape->dots) return SelectStatus::none;
  for (const double step : kBoundSteps) {
    if (!search.run(step * search.max_score_m2)) return SelectStatus::work_budget;
    if (!search.found) continue;
    selection = search.best;
    return SelectStatus::found;
  }
  return search.saw_upside_down ? SelectStatus::only_upside_down : SelectStatus::none;
}

}  // namespace dottrack::acquisition
