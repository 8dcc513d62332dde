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

inline constexpr std::uint16_t kNoCandidate = 0xFFFF;  // of a dot that is left out

// assignment[k] is the finalist chosen for dot k of the target.
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

// The largest score that a set of `dots` dots within the RMS residual limit can have: dots^2 r^2
// for the distances (their squared differences sum to at most dots times the squared residuals),
// and half a diameter for each dot's size, of the largest ones.
double largest_score(const TargetShape& shape, double max_rms_residual_m, std::size_t dots);

enum class SelectStatus : std::uint8_t {
  found,
  none,              // no assignment within the largest score
  only_upside_down,  // some, but every one hangs upside down
  work_budget,       // the budget ran out: the search goes on with the next one
};

struct Selection {
  Assignment assignment{};  // kNoCandidate for the target's dots that are left out, and beyond them
  double score_m2 = 0.0;    // over the dots that are matched
  std::uint8_t dots = 0;    // that are matched
};

struct SelectLimits {
  double max_score_m2 = 0.0;
  std::size_t dots = 0;                  // how many of the target's dots to match, exactly
  const Assignment* excluded = nullptr;  // passed over: what is found is the best of the others
};

// Exact: among all assignments of distinct candidates to `dots` of the target's dots that pass the
// variance and upright tests (taken over the matched dots) and whose score is at most max_score,
// finds the one of least score, of equal ones the lexicographically first - what the paper's search
// over all subsets and permutations finds.
//
// Branch and bound. The bound starts small and grows, since a good match, if there is one, is found
// in the smallest. The search can stop anywhere and go on later: it keeps a stack of its own. A
// unit of its work takes five to twelve nanoseconds on a desktop core; a budget is overdrawn by a
// few hundred units at most, or by one or two a candidate where these are thousands: sorting them
// in, and looking at the neighbours of one, are not interrupted.
class Selector {
 public:
  Selector();
  ~Selector();
  Selector(const Selector&) = delete;
  Selector& operator=(const Selector&) = delete;

  static std::size_t footprint_bytes();

  // Begins a search. What the arguments refer to must stay as it is until the search has ended.
  void start(const TargetShape& shape, std::span<const DotCandidate> candidates,
             const SelectLimits& limits);
  // Goes on until the search has ended or the budget has run out (work_budget).
  SelectStatus advance(WorkBudget& budget, Selection& selection);

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

}  // namespace dottrack::acquisition
