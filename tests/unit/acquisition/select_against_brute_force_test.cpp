// Selection finds what the paper's search finds, bit for bit, and however often it is interrupted.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <ostream>

#include "tests/unit/acquisition/brute_force.h"
#include "tests/unit/acquisition/select_scene.h"

namespace dottrack::acquisition {
namespace {

using test::SelectScene;
using Candidates = std::vector<DotCandidate>;

constexpr std::uint64_t kPlenty = 1'000'000'000;

struct Outcome {
  SelectStatus status = SelectStatus::none;
  Selection selection;
  std::uint64_t work_units = 0;
};

Outcome select_in_slices(const TargetShape& shape, const Candidates& candidates,
                         const SelectLimits& limits, std::uint64_t slice) {
  static Selector selector;
  selector.start(shape, candidates, limits);
  Outcome outcome;
  do {
    WorkBudget budget(slice);
    outcome.status = selector.advance(budget, outcome.selection);
    outcome.work_units += budget.spent();
  } while (outcome.status == SelectStatus::work_budget);
  return outcome;
}

void expect_same(const Selection& a, const Selection& b) {
  EXPECT_EQ(a.assignment, b.assignment);
  EXPECT_EQ(a.score_m2, b.score_m2);
  EXPECT_EQ(a.dots, b.dots);
}

struct Tally {
  int found = 0;
  int none = 0;
  int upside_down = 0;

  void count(SelectStatus status) {
    found += status == SelectStatus::found ? 1 : 0;
    none += status == SelectStatus::none ? 1 : 0;
    upside_down += status == SelectStatus::only_upside_down ? 1 : 0;
  }
};

// Both searches; then both again without what they found.
void compare(const core::Target& target, const Candidates& candidates, SelectLimits limits,
             Tally& tally) {
  const TargetShape shape = make_target_shape(target);
  Assignment excluded;
  for (int round = 0; round < 2; ++round) {
    const test::BruteForce slow = test::brute_force(shape, candidates, limits);
    const Outcome fast = select_in_slices(shape, candidates, limits, kPlenty);
    tally.count(fast.status);
    ASSERT_EQ(fast.status, slow.status);
    if (fast.status != SelectStatus::found) return;
    expect_same(fast.selection, slow.best);
    excluded = slow.best.assignment;
    limits.excluded = &excluded;
  }
}

// How many assignments the paper's search would look at.
std::size_t assignments(std::size_t n, std::size_t m, std::size_t candidates) {
  std::size_t count = 1;
  for (std::size_t i = 0; i < m; ++i) count = count * (n - i) / (i + 1);
  for (std::size_t i = 0; i < m; ++i) count *= candidates - i;
  return count;
}

struct Trial {
  core::Target target;
  Candidates candidates;
  SelectLimits limits;
};

enum class Kind : std::uint8_t { clutter, target, grid, duplicates, mirrored, upside_down };

class Trials {
 public:
  Trials(Kind kind, unsigned seed) : kind_(kind), scene_(seed) {}

  Trial next() {
    const std::size_t n = scene_.integer(3, 6);
    const std::size_t m = scene_.integer(3, n);
    const std::size_t affordable = scene_.integer(1, 20) == 1 ? 40'000 : 8'000;
    std::size_t most = m;
    while (most < 14 && assignments(n, m, most + 1) <= affordable) ++most;
    const std::size_t count = scene_.integer(m, most);
    const bool upright = scene_.integer(0, 2) != 0;
    Trial trial;
    trial.target = kind_ == Kind::grid ? scene_.grid_target(n, upright) : scene_.target(n, upright);
    trial.candidates = candidates(trial.target, m, count);
    const double tolerance_m = scene_.uniform(0.0, 0.06);
    trial.limits = {largest_score(make_target_shape(trial.target), tolerance_m, m), m};
    return trial;
  }

 private:
  Candidates candidates(const core::Target& target, std::size_t m, std::size_t count) {
    if (kind_ == Kind::grid) return scene_.grid(count);
    Candidates found;
    if (kind_ != Kind::clutter) {
      found = scene_.image(target, turn(), scene_.integer(0, 1) == 0 ? 0.0 : 0.01);
      scene_.shuffle(found);
      found.resize(std::min({found.size(), count, scene_.integer(m, found.size())}));
    }
    if (kind_ == Kind::duplicates) {
      while (found.size() < count) found.push_back(found[scene_.integer(0, found.size() - 1)]);
    }
    scene_.add_clutter(count - found.size(), found);
    scene_.shuffle(found);
    return found;
  }

  Eigen::Matrix3d turn() {
    const Eigen::Matrix3d upright = scene_.upright_turn();
    if (kind_ == Kind::mirrored) return upright * SelectScene::mirror();
    return kind_ == Kind::upside_down ? scene_.upside_down_turn() : upright;
  }

  Kind kind_;
  SelectScene scene_;
};

void PrintTo(Kind kind, std::ostream* out) {
  constexpr std::array<const char*, 6> kNames{"clutter",    "target",   "grid",
                                              "duplicates", "mirrored", "upside down"};
  *out << kNames[static_cast<std::size_t>(kind)];
}

class SelectAgainstBruteForce : public testing::TestWithParam<Kind> {};

TEST_P(SelectAgainstBruteForce, FindsTheSame) {
  constexpr int kTrials = 2500;
  Trials trials(GetParam(), 1);
  Tally tally;
  for (int i = 0; i < kTrials && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Trial trial = trials.next();
    compare(trial.target, trial.candidates, trial.limits, tally);
  }
  EXPECT_GE(tally.found, kTrials / 10);
  EXPECT_GE(tally.none, kTrials / 25);
  EXPECT_GE(tally.upside_down, GetParam() == Kind::upside_down ? kTrials / 10 : 0);
}

TEST_P(SelectAgainstBruteForce, MayBeInterruptedAnywhere) {
  Trials trials(GetParam(), 2);
  Tally tally;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const Trial trial = trials.next();
    const TargetShape shape = make_target_shape(trial.target);
    const Outcome whole = select_in_slices(shape, trial.candidates, trial.limits, kPlenty);
    tally.count(whole.status);
    for (const std::uint64_t slice : {0U, 1U, 13U, 1000U}) {
      const Outcome sliced = select_in_slices(shape, trial.candidates, trial.limits, slice);
      EXPECT_EQ(sliced.status, whole.status);
      EXPECT_EQ(sliced.work_units, whole.work_units);
      expect_same(sliced.selection, whole.selection);
    }
  }
  EXPECT_GE(tally.found, 20);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SelectAgainstBruteForce,
                         testing::Values(Kind::clutter, Kind::target, Kind::grid, Kind::duplicates,
                                         Kind::mirrored, Kind::upside_down));

}  // namespace
}  // namespace dottrack::acquisition
