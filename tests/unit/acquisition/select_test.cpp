#include "app/core/acquisition/select.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/acquisition/select_scene.h"

namespace dottrack::acquisition {
namespace {

using Eigen::Vector3d;
using test::SelectScene;

constexpr std::uint64_t kPlenty = 1'000'000'000;

// The whole target at once.
SelectStatus select(Selector& selector, const TargetShape& shape,
                    std::span<const DotCandidate> candidates, double max_score_m2,
                    WorkBudget& budget, Selection& selection,
                    const Assignment* excluded = nullptr) {
  selector.start(shape, candidates, {max_score_m2, shape.dots, excluded});
  return selector.advance(budget, selection);
}

TEST(Select, FindsEveryTargetSizeInClutter) {
  Selector selector;
  int right = 0;
  for (std::size_t n = 4; n <= core::kMaxDots; ++n) {
    SelectScene scene(static_cast<unsigned>(300 + n));
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
  SelectScene scene(7);
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
  SelectScene scene(8);
  const core::Target target = scene.target(4, false);
  const std::vector<DotCandidate> three(3);
  Selector selector;
  WorkBudget budget(kPlenty);
  Selection selection;
  EXPECT_EQ(select(selector, make_target_shape(target), three, 1.0, budget, selection),
            SelectStatus::none);
}

TEST(LargestScore, AdmitsEverySetWithinTheResidualLimit) {
  SelectScene scene(9);
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
