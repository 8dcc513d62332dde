#include "app/core/acquisition/assignment_tree.h"

#include <algorithm>
#include <limits>

namespace dottrack::acquisition {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Options looked at before the budget is asked again.
constexpr std::size_t kSlice = 64;

double squared(double v) {
  return v * v;
}

}  // namespace

void AssignmentTree::begin(const TargetShape& shape, std::span<const DotCandidate> candidates,
                           std::size_t dots) {
  shape_ = &shape;
  candidates_ = candidates;
  needed_ = dots - 1;
  assignment_.fill(kNoCandidate);
  with_options_ = 0;
}

void AssignmentTree::set_anchor(std::size_t dot, std::uint16_t candidate, double cost_m2) {
  with_options_ = 0;
  anchor_cost_m2_ = cost_m2;
  assignment_.fill(kNoCandidate);
  assignment_[dot] = candidate;
}

void AssignmentTree::add(std::size_t dot, const Option& option) {
  if (!holds(with_options_, dot)) {
    with_options_ |= dot_bit(dot);
    options_[dot].clear();
    least_cost_m2_[dot] = kNever;
  }
  options_[dot].push_back(option);
  least_cost_m2_[dot] = std::min(least_cost_m2_[dot], option.cost_m2);
}

bool AssignmentTree::plant(double limit_m2) {
  turns_ = 0;
  for (std::size_t dot = 0; dot < shape_->dots; ++dot) {
    if (!holds(with_options_, dot)) continue;
    std::size_t turn = turns_++;
    const auto fewer = [&](std::size_t a, std::size_t b) {
      return options_[a].size() < options_[b].size();
    };
    for (; turn > 0 && fewer(dot, dot_of_turn_[turn - 1]); --turn) {
      dot_of_turn_[turn] = dot_of_turn_[turn - 1];
    }
    dot_of_turn_[turn] = static_cast<std::uint8_t>(dot);
  }
  if (turns_ < needed_) return false;
  sum_least_rest();
  depth_ = 0;
  stack_[0] = {0, 0, anchor_cost_m2_};
  return anchor_cost_m2_ + least_rest_m2_[0][needed_] <= limit_m2;
}

void AssignmentTree::sum_least_rest() {
  std::array<double, core::kMaxDots> ascending{};
  for (std::size_t t = turns_ + 1; t-- > 0;) {
    const std::size_t count = turns_ - t;
    if (count > 0) {
      const double least = least_cost_m2_[dot_of_turn_[t]];
      std::size_t place = count - 1;
      for (; place > 0 && ascending[place - 1] > least; --place) {
        ascending[place] = ascending[place - 1];
      }
      ascending[place] = least;
    }
    auto& rest = least_rest_m2_[t];
    rest[0] = 0.0;
    for (std::size_t q = 0; q < count; ++q) rest[q + 1] = rest[q] + ascending[q];
  }
}

AssignmentTree::Step AssignmentTree::walk(double limit_m2, WorkBudget& budget) {
  while (!budget.exhausted()) {
    Turn& turn = stack_[depth_];
    const std::size_t dot = dot_of_turn_[depth_];
    if (turn.next < options_[dot].size()) {
      if (examine(turn, limit_m2, budget)) return Step::leaf;
      continue;
    }
    budget.spend(1);
    if (turn.next == options_[dot].size() && leave_out(turn, limit_m2)) continue;
    assignment_[dot] = kNoCandidate;
    if (depth_ == 0) return Step::ended;
    --depth_;
  }
  return Step::work_budget;
}

// Goes through the turn's options to the next that is within the limit; true when it makes the
// assignment whole.
bool AssignmentTree::examine(Turn& turn, double limit_m2, WorkBudget& budget) {
  const std::size_t dot = dot_of_turn_[depth_];
  const Options& options = options_[dot];
  const std::size_t end = std::min(options.size(), turn.next + kSlice);
  const std::size_t needed = needed_ - turn.chosen - 1;
  const double spare_m2 = limit_m2 - least_rest_m2_[depth_ + 1][needed];
  std::size_t distances = 0;
  std::size_t looked = 0;
  bool whole = false;
  while (turn.next < end) {
    const Option& option = options[turn.next++];
    ++looked;
    const double cost_m2 = cost_beside_chosen(turn, dot, option, spare_m2, distances);
    if (!(cost_m2 <= spare_m2)) continue;
    assignment_[dot] = option.candidate;
    whole = needed == 0;
    if (!whole) {
      chosen_[turn.chosen] = {&candidates_[option.candidate], shape_->distance_m[dot].data()};
      stack_[++depth_] = {0, turn.chosen + 1, cost_m2};
    }
    break;
  }
  budget.spend(looked + distances / 2);
  return whole;
}

// The cost with this option added, or more than what is to spare.
double AssignmentTree::cost_beside_chosen(const Turn& turn, std::size_t dot, const Option& option,
                                          double spare_m2, std::size_t& distances) const {
  const DotCandidate& found = candidates_[option.candidate];
  double total_m2 = turn.cost_m2 + option.cost_m2;
  for (std::size_t i = 0; i < turn.chosen && total_m2 <= spare_m2; ++i) {
    if (chosen_[i].found == &found) return kNever;
    ++distances;
    const double distance_m = (chosen_[i].found->position_m - found.position_m).norm();
    total_m2 += squared(distance_m - chosen_[i].edges_m[dot]);
  }
  return total_m2;
}

// After its last option: the turn's dot is left out, if enough others follow.
bool AssignmentTree::leave_out(Turn& turn, double limit_m2) {
  ++turn.next;
  const std::size_t needed = needed_ - turn.chosen;
  if (turns_ - depth_ <= needed) return false;
  if (turn.cost_m2 + least_rest_m2_[depth_ + 1][needed] > limit_m2) return false;
  assignment_[dot_of_turn_[depth_]] = kNoCandidate;
  stack_[depth_ + 1] = {0, turn.chosen, turn.cost_m2};
  ++depth_;
  return true;
}

}  // namespace dottrack::acquisition
