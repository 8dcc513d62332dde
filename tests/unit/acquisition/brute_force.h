#pragma once
// The paper's selection as it is written: every subset of n finalists, every permutation of each.

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "app/core/acquisition/select.h"

namespace dottrack::acquisition::test {

// Calls visit(subset) for every n of the numbers 0 .. total-1, ascending.
template <class Visit>
void for_every_subset(std::size_t total, std::size_t n, std::vector<std::uint16_t>& chosen,
                      std::size_t from, const Visit& visit) {
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

// The best-scoring permutation over all subsets that pass the paper's tests; of equal scores the
// lexicographically first; none when the best score is above max_score.
inline std::optional<Selection> brute_force(const TargetShape& shape,
                                            std::span<const DotCandidate> candidates,
                                            double max_score_m2) {
  std::optional<Selection> best;
  std::vector<std::uint16_t> chosen;
  for_every_subset(
      candidates.size(), shape.dots, chosen, 0, [&](std::vector<std::uint16_t> subset) {
        do {
          Selection trial;
          std::copy(subset.begin(), subset.end(), trial.assignment.begin());
          trial.score_m2 = match_score(shape, candidates, trial.assignment);
          if (trial.score_m2 > max_score_m2) continue;
          if (best && (trial.score_m2 > best->score_m2 || (trial.score_m2 == best->score_m2 &&
                                                           trial.assignment >= best->assignment))) {
            continue;
          }
          if (!passes_variance_test(shape, candidates, trial.assignment) ||
              !passes_upright_test(shape, candidates, trial.assignment)) {
            continue;
          }
          best = trial;
        } while (std::next_permutation(subset.begin(), subset.end()));
      });
  return best;
}

}  // namespace dottrack::acquisition::test
