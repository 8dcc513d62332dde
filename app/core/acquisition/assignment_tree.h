#pragma once
// All assignments that hold one candidate for one dot, the anchor, depth first and bounded by cost.
// The walk keeps a stack of its own, so that it can stop after any step and go on later.

#include <array>
#include <cstdint>
#include <span>

#include "app/core/acquisition/edge_table.h"
#include "app/core/acquisition/select.h"
#include "hal/base/static_vector.h"

namespace dottrack::acquisition {

// A candidate for one dot beside the anchor, with what it adds to the score by itself.
struct Option {
  std::uint16_t candidate = 0;
  double cost_m2 = 0.0;  // its diameter and its distance to the anchor
};

class AssignmentTree {
 public:
  void begin(const TargetShape& shape, std::span<const DotCandidate> candidates, std::size_t dots);
  // Forgets all options. `cost_m2` is what the anchor adds to the score by itself.
  void set_anchor(std::size_t dot, std::uint16_t candidate, double cost_m2);
  void add(std::size_t dot, const Option& option);

  // Once all options are there. False when no assignment can cost less than the limit.
  bool plant(double limit_m2);

  enum class Step : std::uint8_t { leaf, ended, work_budget };
  // Goes on to the next assignment whose cost is within the limit, which may have fallen since.
  Step walk(double limit_m2, WorkBudget& budget);
  // Of the leaf.
  const Assignment& assignment() const { return assignment_; }

 private:
  using Options = StaticVector<Option, core::kMaxFinalists>;

  // One dot's turn.
  struct Turn {
    std::size_t next = 0;  // of its options; past them, whether the dot was left out has been tried
    std::size_t chosen = 0;  // candidates chosen in the turns before
    double cost_m2 = 0.0;    // of those, the anchor included
  };
  struct Chosen {
    const DotCandidate* found = nullptr;
    const double* edges_m = nullptr;  // from its dot to every other
  };

  bool examine(Turn& turn, double limit_m2, WorkBudget& budget);
  double cost_beside_chosen(const Turn& turn, std::size_t dot, const Option& option,
                            double spare_m2, std::size_t& distances) const;
  bool leave_out(Turn& turn, double limit_m2);
  void sum_least_rest();

  const TargetShape* shape_ = nullptr;
  std::span<const DotCandidate> candidates_;
  std::size_t needed_ = 0;  // dots to match beside the anchor
  double anchor_cost_m2_ = 0.0;

  std::array<Options, core::kMaxDots> options_;         // by dot
  std::array<double, core::kMaxDots> least_cost_m2_{};  // of a dot's options
  DotSet with_options_ = 0;
  std::size_t turns_ = 0;
  std::array<std::uint8_t, core::kMaxDots> dot_of_turn_{};  // fewest options first
  // [t][q]: the least that q dots can add from turn t on.
  std::array<std::array<double, core::kMaxDots + 1>, core::kMaxDots + 1> least_rest_m2_{};

  std::size_t depth_ = 0;
  std::array<Turn, core::kMaxDots> stack_{};
  std::array<Chosen, core::kMaxDots> chosen_{};
  Assignment assignment_{};
};

}  // namespace dottrack::acquisition
