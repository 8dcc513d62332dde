#include "app/core/acquisition/select.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

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

// As many candidates as there can be, on a lattice that fits the edges of a target from the same
// lattice everywhere: a search without end for all that matters.
class Lattice : public testing::Test {
 protected:
  Lattice() {
    core::Target target;
    for (int i = 0; i < static_cast<int>(core::kMaxDots); ++i) {
      target.dots.push_back({kStep_m * Vector3d(i % 4, i / 4, i % 3 == 0 ? 1 : 0), 0.1, {}});
    }
    shape_ = make_target_shape(target);
    for (int i = 0; i < static_cast<int>(core::kMaxFinalists); ++i) {
      candidates_.push_back({kStep_m * Vector3d(i % 20, i / 20 % 20, i / 400), 0.1});
    }
  }

  static constexpr double kStep_m = 0.25;
  TargetShape shape_;
  std::vector<DotCandidate> candidates_;
};

TEST_F(Lattice, OverdrawsItsBudgetByLittle) {
  Selector selector;
  Selection selection;
  for (const std::size_t dots : {std::size_t{4}, std::size_t{10}, core::kMaxDots}) {
    selector.start(shape_, candidates_, {largest_score(shape_, 0.05, dots), dots});
    for (int slice = 0; slice < 1000; ++slice) {
      WorkBudget budget(1000);
      ASSERT_EQ(selector.advance(budget, selection), SelectStatus::work_budget);
      // Sorting the candidates into the grid cannot be interrupted; all else is a matter of a few
      // hundred units, or of a few thousand where one candidate has thousands of neighbours.
      const std::uint64_t most = slice == 0 ? 1000 + core::kMaxFinalists + 100 : 1000 + 3500;
      ASSERT_LE(budget.spent(), most) << dots << " dots, slice " << slice;
    }
  }
}

TEST_F(Lattice, GivesWayToTheNextSearch) {
  Selector selector;
  Selection selection;
  WorkBudget little(5000);
  selector.start(shape_, candidates_, {largest_score(shape_, 0.05, 8), 8});
  ASSERT_EQ(selector.advance(little, selection), SelectStatus::work_budget);

  SelectScene scene(10);
  const core::Target target = scene.target(6, true);
  const TargetShape shape = make_target_shape(target);
  const auto candidates = scene.scene(target, 50, 0.001);
  WorkBudget budget(kPlenty);
  EXPECT_EQ(select(selector, shape, candidates, 0.001, budget, selection), SelectStatus::found);
  WorkBudget none(0);
  Selection again;
  EXPECT_EQ(selector.advance(none, again), SelectStatus::found);
  EXPECT_EQ(none.spent(), 0U);
  EXPECT_EQ(again.assignment, selection.assignment);
}

TEST(Select, TakesLittleMemory) {
  EXPECT_LT(Selector::footprint_bytes(), 4U << 20U);
}

// Every number of the dots of every target, in clutter: those that are there are found.
TEST(Select, FindsThePartOfTheTargetThatIsThere) {
  Selector selector;
  int right = 0;
  for (std::size_t n = 6; n <= core::kMaxDots; ++n) {
    SelectScene scene(static_cast<unsigned>(400 + n));
    const core::Target target = scene.target(n, true);
    const TargetShape shape = make_target_shape(target);
    for (std::size_t m = 5; m < n; ++m) {
      auto candidates = scene.image(target, scene.upright_turn(), 0.001);
      candidates.resize(m);
      scene.add_clutter(30, candidates);
      selector.start(shape, candidates, {largest_score(shape, 0.004, m), m});
      WorkBudget budget(kPlenty);
      Selection selection;
      ASSERT_EQ(selector.advance(budget, selection), SelectStatus::found) << m << " of " << n;
      EXPECT_EQ(selection.dots, m);
      for (std::size_t k = 0; k < n; ++k) {
        right += selection.assignment[k] == (k < m ? k : kNoCandidate) ? 1 : 0;
      }
      EXPECT_EQ(selection.score_m2, match_score(shape, candidates, selection.assignment));
    }
  }
  EXPECT_EQ(right, 836);
}

TEST(Select, RefusesWhatCannotBe) {
  SelectScene scene(11);
  const core::Target target = scene.target(4, false);
  const TargetShape shape = make_target_shape(target);
  const auto candidates = scene.scene(target, 0, 0.0);
  Selector selector;
  for (const SelectLimits& limits :
       {SelectLimits{1.0, 2}, SelectLimits{1.0, 5}, SelectLimits{-1.0, 4}}) {
    WorkBudget budget(kPlenty);
    Selection selection;
    selector.start(shape, candidates, limits);
    EXPECT_EQ(selector.advance(budget, selection), SelectStatus::none);
  }
}

TEST(Select, PassesOverCandidatesThatAreNowhere) {
  SelectScene scene(12);
  const core::Target target = scene.target(5, true);
  const TargetShape shape = make_target_shape(target);
  auto candidates = scene.scene(target, 20, 0.001);
  const double nowhere = std::numeric_limits<double>::infinity();
  candidates.push_back({{nowhere, 0.0, 0.0}, 0.1});
  candidates.push_back({{0.0, std::nan(""), 0.0}, 0.1});
  candidates.push_back({candidates.front().position_m, std::nan("")});
  Selector selector;
  WorkBudget budget(kPlenty);
  Selection selection;
  EXPECT_EQ(select(selector, shape, candidates, 0.001, budget, selection), SelectStatus::found);
}

// The scores of a part are those of a target that has no other dots.
TEST(Score, OfAPartIsThatOfTheTargetsMatchedDots) {
  SelectScene scene(13);
  int upright = 0;
  int in_variance = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const core::Target whole = scene.target(6, true);
    core::Target part = whole;
    part.dots.erase(part.dots.begin() + 4);
    part.dots.erase(part.dots.begin() + 1);
    const TargetShape of_whole = make_target_shape(whole);
    const TargetShape of_part = make_target_shape(part);
    std::vector<DotCandidate> candidates;
    scene.add_clutter(4, candidates);
    Assignment in_whole;
    Assignment in_part;
    in_whole.fill(kNoCandidate);
    in_part.fill(kNoCandidate);
    constexpr std::array<std::size_t, 4> kDots{0, 2, 3, 5};
    for (std::uint16_t i = 0; i < 4; ++i) in_whole[kDots[i]] = in_part[i] = i;
    EXPECT_EQ(match_score(of_whole, candidates, in_whole),
              match_score(of_part, candidates, in_part));
    const bool passes = passes_variance_test(of_whole, candidates, in_whole);
    EXPECT_EQ(passes, passes_variance_test(of_part, candidates, in_part));
    in_variance += passes ? 1 : 0;
    const bool stands = passes_upright_test(of_whole, candidates, in_whole);
    EXPECT_EQ(stands, passes_upright_test(of_part, candidates, in_part));
    upright += stands ? 1 : 0;
  }
  EXPECT_GE(upright, 100);
  EXPECT_LE(upright, 400);
  EXPECT_GE(in_variance, 50);
  EXPECT_LE(in_variance, 450);
}

TEST(TargetShape, AnchorsAreAllItsDotsTheMostCentralFirst) {
  core::Target target;
  for (const double x : {0.0, 1.0, 3.0, 3.5})
    target.dots.push_back({{x, 0.1 * x * x, 0.0}, 0.1, {}});
  const TargetShape shape = make_target_shape(target);
  const std::vector<int> anchors(shape.anchors.begin(), shape.anchors.begin() + 4);
  EXPECT_EQ(anchors, (std::vector<int>{1, 2, 0, 3}));
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
