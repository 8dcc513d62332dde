#pragma once
// The paper's selection as it is written: every subset of n finalists, every permutation of each;
// and, where only some of the target's dots are to be matched, every subset of those, too.

#include <algorithm>
#include <span>
#include <vector>

#include "app/core/acquisition/select.h"

namespace dottrack::acquisition::test {

using Subset = std::vector<std::uint16_t>;

// Calls visit(subset) for every n of the numbers 0 .. total-1, ascending.
template <class Visit>
void for_every_subset(std::size_t total, std::size_t n, Subset& chosen, std::size_t from,
                      const Visit& visit) {
  if (chosen.size() == n) {
    visit(chosen);
    return;
  }
  for (std::size_t i = from; i < total; ++i) {
    chosen.push_back(static_cast<std::uint16_t>(i));
    for_every_subset(total, n, chosen, i + 1, visit);
    chosen.pop_back();
  }
}

// The best-scoring assignment so far, of equal scores the lexicographically first.
struct BruteForce {
  const TargetShape& shape;
  std::span<const DotCandidate> candidates;
  SelectLimits limits;
  SelectStatus status = SelectStatus::none;
  Selection best = {};

  void judge(const Assignment& assignment) {
    const double score_m2 = match_score(shape, candidates, assignment);
    if (score_m2 > limits.max_score_m2) return;
    const bool found = status == SelectStatus::found;
    if (found && (score_m2 > best.score_m2 ||
                  (score_m2 == best.score_m2 && assignment >= best.assignment))) {
      return;
    }
    if (limits.excluded != nullptr && assignment == *limits.excluded) return;
    if (!passes_variance_test(shape, candidates, assignment)) return;
    if (passes_upright_test(shape, candidates, assignment)) {
      status = SelectStatus::found;
      best = {assignment, score_m2, static_cast<std::uint8_t>(limits.dots)};
    } else if (!found) {
      status = SelectStatus::only_upside_down;
    }
  }

  void judge_permutations(const Subset& dots, Subset chosen) {
    do {
      Assignment assignment;
      assignment.fill(kNoCandidate);
      for (std::size_t i = 0; i < dots.size(); ++i) assignment[dots[i]] = chosen[i];
      judge(assignment);
    } while (std::next_permutation(chosen.begin(), chosen.end()));
  }
};

inline BruteForce brute_force(const TargetShape& shape, std::span<const DotCandidate> candidates,
                              const SelectLimits& limits) {
  BruteForce search{shape, candidates, limits};
  Subset dots;
  for_every_subset(shape.dots, limits.dots, dots, 0, [&](const Subset& of_dots) {
    Subset chosen;
    for_every_subset(candidates.size(), limits.dots, chosen, 0,
                     [&](const Subset& subset) { search.judge_permutations(of_dots, subset); });
  });
  return search;
}

}  // namespace dottrack::acquisition::test
