#include "app/core/acquisition/select.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/acquisition/brute_force.h"

namespace dottrack::acquisition {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kPlenty = 1'000'000'000;

// The whole target at once.
SelectStatus select(Selector& selector, const TargetShape& shape,
                    std::span<const DotCandidate> candidates, double max_score_m2,
                    WorkBudget& budget, Selection& selection,
                    const Assignment* excluded = nullptr) {
  selector.start(shape, candidates, {max_score_m2, shape.dots, excluded});
  return selector.advance(budget, selection);
}

class Scene {
 public:
  explicit Scene(unsigned seed) : random_(seed) {}

  core::Target target(std::size_t n, bool upright) {
    core::Target t;
    t.upright = upright;
    for (std::size_t i = 0; i < n; ++i) t.dots.push_back({vector({0.5, 0.4, 0.1}), 0.1, {}});
    return t;
  }

  // The target's dots, moved upright somewhere, with noise; then clutter around them.
  std::vector<DotCandidate> scene(const core::Target& target, std::size_t clutter, double noise_m) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(uniform(-3.0, 3.0), Vector3d::UnitZ()));
    const Vector3d place = vector({3.0, 3.0, 0.3});
    std::vector<DotCandidate> candidates;
    for (const core::TargetDot& dot : target.dots) {
      candidates.push_back({turn * dot.position_m + place + vector(Vector3d::Constant(noise_m)),
                            dot.diameter_m + uniform(-noise_m, noise_m)});
    }
    for (std::size_t i = 0; i < clutter; ++i) {
      candidates.push_back({place + vector({0.8, 0.8, 0.3}), 0.1 + uniform(-0.03, 0.03)});
    }
    std::shuffle(candidates.begin(), candidates.end(), random_);
    return candidates;
  }

  // Candidates on a coarse grid: many distances are exactly equal.
  std::vector<DotCandidate> grid(std::size_t n) {
    std::vector<DotCandidate> candidates;
    std::uniform_int_distribution<int> step(0, 3);
    for (std::size_t i = 0; i < n; ++i) {
      candidates.push_back({0.25 * Vector3d(step(random_), step(random_), step(random_)), 0.1});
    }
    return candidates;
  }

  double uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random_);
  }
  Vector3d vector(const Vector3d& reach) {
    return {uniform(-reach.x(), reach.x()), uniform(-reach.y(), reach.y()),
            uniform(-reach.z(), reach.z())};
  }

 private:
  std::mt19937 random_;
};

// Counts the scenes in which both searches found something.
int compare(const TargetShape& shape, std::span<const DotCandidate> candidates, double max_score) {
  static Selector selector;
  WorkBudget budget(kPlenty);
  Selection fast;
  const SelectStatus status = select(selector, shape, candidates, max_score, budget, fast);
  const auto slow = test::brute_force(shape, candidates, max_score);
  EXPECT_EQ(status == SelectStatus::found, slow.has_value());
  if (status != SelectStatus::found || !slow) return 0;
  EXPECT_EQ(fast.assignment, slow->assignment);
  EXPECT_EQ(fast.score_m2, slow->score_m2);
  return 1;
}

class SelectAgainstBruteForce : public testing::TestWithParam<std::size_t> {};

TEST_P(SelectAgainstBruteForce, OnScenesWithTheTarget) {
  const std::size_t n = GetParam();
  const std::size_t clutter = n == 3 ? 25 : n == 4 ? 14 : 8;
  Scene scene(static_cast<unsigned>(n));
  int found = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const core::Target target = scene.target(n, trial % 2 == 0);
    const TargetShape shape = make_target_shape(target);
    found +=
        compare(shape, scene.scene(target, clutter, 0.01), largest_score(shape, 0.02, shape.dots));
  }
  EXPECT_GE(found, 50);
}

TEST_P(SelectAgainstBruteForce, OnScenesWithoutTheTarget) {
  const std::size_t n = GetParam();
  Scene scene(100 + static_cast<unsigned>(n));
  int found = 0;
  int none = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const core::Target target = scene.target(n, trial % 2 == 0);
    const TargetShape shape = make_target_shape(target);
    const auto clutter = scene.scene(scene.target(3, true), n == 3 ? 20 : 9, 0.0);
    const int hit = compare(shape, clutter, largest_score(shape, 0.03, shape.dots));
    found += hit;
    none += 1 - hit;
  }
  EXPECT_GE(found + none, 60);
  EXPECT_GE(none, n == 3 ? 0 : 20);
}

TEST_P(SelectAgainstBruteForce, OnTies) {
  const std::size_t n = GetParam();
  Scene scene(200 + static_cast<unsigned>(n));
  int found = 0;
  for (int trial = 0; trial < 40; ++trial) {
    core::Target target;
    target.upright = false;
    const auto corners = scene.grid(n);
    for (const DotCandidate& corner : corners) target.dots.push_back({corner.position_m, 0.1, {}});
    found += compare(make_target_shape(target), scene.grid(n == 3 ? 24 : n == 4 ? 16 : 11), 0.2);
  }
  EXPECT_GE(found, 20);
}

INSTANTIATE_TEST_SUITE_P(Dots, SelectAgainstBruteForce, testing::Values(3U, 4U, 5U));

TEST(Select, FindsEveryTargetSizeInClutter) {
  Selector selector;
  int right = 0;
  for (std::size_t n = 4; n <= core::kMaxDots; ++n) {
    Scene scene(static_cast<unsigned>(300 + n));
    const core::Target target = scene.target(n, true);
    const TargetShape shape = make_target_shape(target);
    const auto candidates = scene.scene(target, 300, 0.002);
    WorkBudget budget(kPlenty);
    Selection selection;
    ASSERT_EQ(select(selector, shape, candidates, largest_score(shape, 0.01, shape.dots), budget,
                     selection),
              SelectStatus::found)
        << n << " dots";
    EXPECT_EQ(selection.score_m2, match_score(shape, candidates, selection.assignment));
    EXPECT_LT(selection.score_m2, static_cast<double>(n * n) * 0.002 * 0.002 * 4.0);
    ++right;
  }
  EXPECT_EQ(right, 13);
}

TEST(Select, AnUprightTargetNeverHangsUpsideDown) {
  // An isosceles triangle is its own mirror image: swapping two dots turns it upside down.
  core::Target target;
  target.dots = {
      {{0.4, 0.0, 0.0}, 0.1, {}}, {{-0.2, 0.3, 0.0}, 0.1, {}}, {{-0.2, -0.3, 0.0}, 0.1, {}}};
  const TargetShape shape = make_target_shape(target);
  const std::vector<DotCandidate> candidates = {
      {{-0.2, -0.3, 1.0}, 0.1}, {{0.4, 0.0, 1.0}, 0.1}, {{-0.2, 0.3, 1.0}, 0.1}};
  Selector selector;
  WorkBudget budget(kPlenty);
  Selection selection;
  ASSERT_EQ(select(selector, shape, candidates, 0.01, budget, selection), SelectStatus::found);
  EXPECT_EQ(selection.assignment[0], 1);
  EXPECT_EQ(selection.assignment[1], 2);
  EXPECT_EQ(selection.assignment[2], 0);
}

TEST(Select, SaysWhenTheOnlyMatchIsUpsideDown) {
  core::Target target;
  target.dots = {
      {{0.4, 0.0, 0.0}, 0.1, {}}, {{-0.2, 0.35, 0.0}, 0.1, {}}, {{-0.1, -0.3, 0.0}, 0.1, {}}};
  const TargetShape shape = make_target_shape(target);
  std::vector<DotCandidate> candidates;
  for (const core::TargetDot& dot : target.dots) {
    candidates.push_back({{dot.position_m.x(), -dot.position_m.y(), 1.0}, 0.1});
  }
  Selector selector;
  WorkBudget budget(kPlenty);
  Selection selection;
  EXPECT_EQ(select(selector, shape, candidates, 0.001, budget, selection),
            SelectStatus::only_upside_down);
}

TEST(Select, RefusesASetOfTwiceTheTargetsVariance) {
  core::Target target;
  target.upright = false;
  target.dots = {
      {{0.0, 0.0, 0.0}, 0.1, {}}, {{0.3, 0.0, 0.0}, 0.1, {}}, {{0.0, 0.4, 0.0}, 0.1, {}}};
  const TargetShape shape = make_target_shape(target);
  std::vector<DotCandidate> candidates;
  for (const core::TargetDot& dot : target.dots) candidates.push_back({1.45 * dot.position_m, 0.1});
  Selector selector;
  WorkBudget budget(kPlenty);
  Selection selection;
  EXPECT_EQ(select(selector, shape, candidates, 1.0, budget, selection), SelectStatus::none);
  for (DotCandidate& c : candidates) c.position_m *= 1.38 / 1.45;
  EXPECT_EQ(select(selector, shape, candidates, 1.0, budget, selection), SelectStatus::found);
}

TEST(Select, StopsAtItsBudgetAndSaysSo) {
  Scene scene(7);
  const core::Target target = scene.target(5, false);
  const TargetShape shape = make_target_shape(target);
  const auto candidates = scene.scene(target, 1000, 0.05);
  Selector selector;
  WorkBudget budget(2000);
  Selection selection;
  EXPECT_EQ(select(selector, shape, candidates, largest_score(shape, 0.05, shape.dots), budget,
                   selection),
            SelectStatus::work_budget);
  EXPECT_TRUE(budget.exhausted());
}

TEST(Select, NeedsAsManyCandidatesAsDots) {
  Scene scene(8);
  const core::Target target = scene.target(4, false);
  const std::vector<DotCandidate> three(3);
  Selector selector;
  WorkBudget budget(kPlenty);
  Selection selection;
  EXPECT_EQ(select(selector, make_target_shape(target), three, 1.0, budget, selection),
            SelectStatus::none);
}

TEST(LargestScore, AdmitsEverySetWithinTheResidualLimit) {
  Scene scene(9);
  for (int trial = 0; trial < 500; ++trial) {
    const core::Target target = scene.target(4 + static_cast<std::size_t>(trial % 5), false);
    const TargetShape shape = make_target_shape(target);
    // Displacements that sum to nothing are what a least-squares fit leaves, at the most.
    std::vector<DotCandidate> candidates;
    double sum2 = 0.0;
    for (const core::TargetDot& dot : target.dots) {
      const Vector3d shift = scene.vector(Vector3d::Constant(0.05));
      sum2 += shift.squaredNorm();
      candidates.push_back({dot.position_m + shift, dot.diameter_m});
    }
    Assignment identity{};
    for (std::size_t i = 0; i < shape.dots; ++i) identity[i] = static_cast<std::uint16_t>(i);
    const double rms = std::sqrt(sum2 / static_cast<double>(shape.dots));
    EXPECT_LE(match_score(shape, candidates, identity), largest_score(shape, rms, shape.dots));
  }
}

}  // namespace
}  // namespace dottrack::acquisition
