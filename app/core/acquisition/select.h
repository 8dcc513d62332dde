#pragma once
// Select: the n finalists, in order, that best match the target (paper section 3.1.4).

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "app/core/acquisition/target_shape.h"
#include "app/core/acquisition/work_budget.h"
#include "app/core/limits.h"

namespace dottrack::acquisition {

// A finalist as selection sees it.
struct DotCandidate {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // world
  double diameter_m = 0.0;
};

// candidate[k] is the finalist chosen for dot k of the target.
using Assignment = std::array<std::uint16_t, core::kMaxDots>;

// Sum over all pairs of dots of the squared difference of their distances, found and ideal, plus
// the sum over all dots of the squared difference of their diameters; square metres.
double match_score(const TargetShape& shape, std::span<const DotCandidate> candidates,
                   const Assignment& assignment);

// Mean squared distance of the chosen candidates from their mean is at most twice the target's.
bool passes_variance_test(const TargetShape& shape, std::span<const DotCandidate> candidates,
                          const Assignment& assignment);

// The target, carried onto the chosen candidates, has its z axis up. True for targets that need
// not be upright; false when the chosen candidates determine no orientation.
bool passes_upright_test(const TargetShape& shape, std::span<const DotCandidate> candidates,
                         const Assignment& assignment);

// The largest score that a set within the RMS residual limit can have: n^2 r^2 for the distances
// (their squared differences sum to at most n times the squared residuals), and half a diameter
// for each dot's size.
double largest_score(const TargetShape& shape, double max_rms_residual_m);

enum class SelectStatus : std::uint8_t {
  found,
  none,              // no assignment within the largest score
  only_upside_down,  // some, but every one hangs upside down
  work_budget,       // the bound of work was reached before the search was complete
};

struct Selection {
  Assignment assignment{};
  double score_m2 = 0.0;
};

// Exact: among all assignments of distinct candidates that pass the variance and upright tests and
// whose score is at most max_score, finds the one of least score, of equal ones the
// lexicographically first - what the paper's search over all subsets and permutations finds.
//
// Branch and bound: the anchor dot is tried on every candidate; the others' candidates are those at
// the right distance from it; partial scores that exceed the best are cut. The bound starts small
// and grows, since a good match, if there is one, is found in the smallest.
class Selector {
 public:
  Selector();
  ~Selector();
  Selector(const Selector&) = delete;
  Selector& operator=(const Selector&) = delete;

  static std::size_t footprint_bytes();

  // With `excluded`, that one assignment is passed over: what is found is the best of the others.
  SelectStatus select(const TargetShape& shape, std::span<const DotCandidate> candidates,
                      double max_score_m2, WorkBudget& budget, Selection& selection,
                      const Assignment* excluded = nullptr);

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

}  // namespace dottrack::acquisition
