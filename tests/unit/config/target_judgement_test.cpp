// Which relabellings of a target's dots fit, against the brute force and on shapes whose
// symmetries are known.

#include "app/config/target_judgement.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "app/core/geometry/orientation.h"

namespace dottrack::config {
namespace {

using Eigen::Vector3d;

constexpr double kSigma_m = 0.002;

core::Target target_of(const std::vector<Vector3d>& places, bool upright = true) {
  core::Target target;
  for (const Vector3d& p : places) target.dots.push_back({p, 0.05, std::nullopt});
  target.upright = upright;
  return target;
}

core::Target grid(int columns, int rows) {
  std::vector<Vector3d> places;
  for (int i = 0; i < columns * rows; ++i) {
    places.emplace_back(0.3 * (i % columns), 0.3 * (i / columns), 0.5);
  }
  return target_of(places);
}

core::Target random_target(std::size_t dots, std::uint32_t seed, double height_m = 0.0) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random()) / 0x1p32; };
  std::vector<Vector3d> places;
  while (places.size() < dots) {
    const double x = 1.2 * uniform();
    const double y = 0.8 * uniform();
    const Vector3d p(x, y, height_m * uniform());
    const auto apart = [&](const Vector3d& q) { return (p - q).norm() > 0.1; };
    if (std::all_of(places.begin(), places.end(), apart)) places.push_back(p);
  }
  return target_of(places);
}

// Least total misfit of all relabellings of `dots` dots, by trying every one.
double brute_force_m(const core::Target& target, std::size_t dots, double noticeable_m) {
  const std::size_t count = target.dots.size();
  double least_m = std::numeric_limits<double>::infinity();
  std::vector<Vector3d> from;
  std::vector<Vector3d> to;
  std::vector<std::size_t> labels(count);
  const auto measure = [&](const std::vector<std::size_t>& chosen) {
    from.clear();
    to.clear();
    bool identity = true;
    for (std::size_t k = 0; k < dots; ++k) {
      from.push_back(target.dots[chosen[k]].position_m);
      to.push_back(target.dots[labels[k]].position_m);
      identity = identity && chosen[k] == labels[k];
    }
    geometry::RigidMotion motion;
    if (identity ||
        geometry::absolute_orientation(from, to, motion) != geometry::OrientationStatus::ok) {
      return;
    }
    if (target.upright && !((motion.rotation * Vector3d::UnitZ()).z() > 0.0)) return;
    double shift2 = 0.0;
    for (const core::TargetDot& dot : target.dots) {
      shift2 += (motion * dot.position_m - dot.position_m).squaredNorm();
    }
    if (std::sqrt(shift2 / static_cast<double>(count)) <= noticeable_m) return;
    least_m = std::min(
        least_m, geometry::rms_residual(from, to, motion) * std::sqrt(static_cast<double>(dots)));
  };
  std::vector<std::size_t> chosen(dots);
  const auto each_labelling = [&](const auto& self, std::size_t k) -> void {
    if (k == dots) return measure(chosen);
    for (std::size_t label = 0; label < count; ++label) {
      if (std::find(labels.begin(), labels.begin() + static_cast<long>(k), label) !=
          labels.begin() + static_cast<long>(k)) {
        continue;
      }
      labels[k] = label;
      self(self, k + 1);
    }
  };
  const auto each_subset = [&](const auto& self, std::size_t k, std::size_t first) -> void {
    if (k == dots) return each_labelling(each_labelling, 0);
    for (std::size_t dot = first; dot < count; ++dot) {
      chosen[k] = dot;
      self(self, k + 1, dot + 1);
    }
  };
  each_subset(each_subset, 0, 0);
  return least_m;
}

TEST(RelabellingSearch, FindsWhatTheBruteForceFinds) {
  int compared = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const std::size_t count = 3 + seed % 4;
    core::Target target = random_target(count, seed, seed % 3 == 0 ? 0.4 : 0.0);
    target.upright = seed % 2 == 0;
    for (std::size_t dots = std::min<std::size_t>(count, 4); dots <= count; ++dots) {
      const double expected_m = brute_force_m(target, dots, 0.006);
      RelabellingSearch search(target, 0.006);
      const LeastMisfit least = search.least(dots, 0.5);
      EXPECT_TRUE(search.complete());
      if (expected_m > 0.5) {
        EXPECT_FALSE(least.relabelling.has_value());
        continue;
      }
      ASSERT_TRUE(least.relabelling.has_value()) << "seed " << seed;
      EXPECT_NEAR(least.relabelling->total_m, expected_m, 1e-9) << "seed " << seed;
      EXPECT_EQ(least.relabelling->dots, dots);
      EXPECT_TRUE(search.any(dots, 1.001 * expected_m));
      EXPECT_FALSE(search.any(dots, 0.999 * expected_m));
      ++compared;
    }
  }
  EXPECT_GE(compared, 60);
}

TEST(RelabellingSearch, TheLargestIsTheLastThatHasAMisfitSoSmall) {
  int found = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const core::Target target = random_target(9, seed);
    RelabellingSearch search(target, 0.006);
    for (const double limit_m : {0.03, 0.1}) {
      const auto largest = search.largest(4, limit_m);
      std::size_t expected = 0;
      for (std::size_t dots = 4; dots <= 9; ++dots) {
        if (search.any(dots, limit_m)) expected = dots;
      }
      EXPECT_EQ(largest ? largest->dots : 0, expected) << "seed " << seed;
      if (largest) {
        EXPECT_LE(largest->total_m, limit_m);
        ++found;
      }
    }
  }
  EXPECT_GE(found, 10);
}

TEST(TargetJudgement, ASquareIsAmbiguous) {
  const TargetJudgement judgement = judge(grid(2, 2), kSigma_m);
  ASSERT_TRUE(judgement.ambiguous());
  EXPECT_NEAR(judgement.all.relabelling->total_m, 0.0, 1e-9);
  EXPECT_EQ(judgement.dots_needed(), 5U);
}

// Turned over, a kite is itself; turned about the vertical it is not.
TEST(TargetJudgement, AMirroredTargetIsAmbiguousOnlyWhenItMayTurnOver) {
  core::Target kite = target_of({{-0.4, 0, 0}, {0.5, 0, 0}, {0.1, 0.3, 0}, {0.1, -0.3, 0}});
  EXPECT_FALSE(judge(kite, kSigma_m).ambiguous());
  kite.upright = false;
  const TargetJudgement judgement = judge(kite, kSigma_m);
  ASSERT_TRUE(judgement.ambiguous());
  EXPECT_NEAR(judgement.all.relabelling->turn_rad, std::numbers::pi, 1e-6);
  EXPECT_EQ(judgement.all.relabelling->label[2], 3);
}

TEST(TargetJudgement, MirrorImagesInSpaceAreNotRelabellings) {
  // Two dots change places under a reflection, which no rigid motion is.
  const core::Target target =
      target_of({{0, 0, 0}, {0.7, 0, 0}, {0.2, 0, 0.5}, {0.3, 0.4, 0.1}, {0.3, -0.4, 0.1}}, false);
  EXPECT_FALSE(judge(target, kSigma_m).ambiguous());
}

TEST(TargetJudgement, DotsOfDifferentSizesAreToldApart) {
  core::Target target = grid(2, 2);
  target.dots[0].diameter_m = 0.060;
  EXPECT_TRUE(judge(target, kSigma_m).ambiguous());
  target.dots[0].diameter_m = 0.070;
  EXPECT_FALSE(judge(target, kSigma_m).ambiguous());
}

TEST(TargetJudgement, TheLimitFollowsTheNoise) {
  core::Target target = grid(2, 2);
  target.dots[0].position_m.x() -= 0.03;
  EXPECT_FALSE(judge(target, 0.002).ambiguous());
  EXPECT_TRUE(judge(target, 0.004).ambiguous());
}

TEST(TargetJudgement, AHarmlessSwapIsNoAmbiguity) {
  // Two dots so near each other that the pose is the same, whichever is which.
  core::Target target =
      target_of({{0, 0, 0}, {0.9, 0.1, 0}, {0.2, 0.7, 0}, {1.3, 0.9, 0}, {0.5, 0.4, 0}});
  target.dots.push_back({{0.505, 0.4, 0.0}, 0.004, std::nullopt});
  target.dots[4].diameter_m = 0.004;
  EXPECT_FALSE(judge(target, 0.003).ambiguous());
}

TEST(TargetJudgement, SaysOfHowManyDotsNoneCanBeMistaken) {
  // Four of the corners of a regular hexagon are four others of them, turned; the dots inside
  // tell the whole target from itself.
  std::vector<Vector3d> places;
  for (int i = 0; i < 6; ++i) {
    const double angle = i * std::numbers::pi / 3.0;
    places.emplace_back(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.0);
  }
  places.emplace_back(0.11, 0.23, 0.0);
  const TargetJudgement judgement = judge(target_of(places), kSigma_m);
  EXPECT_FALSE(judgement.ambiguous());
  ASSERT_TRUE(judgement.few.relabelling.has_value());
  EXPECT_NEAR(judgement.few.relabelling->total_m, 0.0, 1e-9);
  EXPECT_EQ(judgement.few.relabelling->dots, 4U);
  EXPECT_EQ(judgement.most->dots, 6U);
  EXPECT_EQ(judgement.dots_needed(), 7U);
}

// 16 dots without bounds would be 2e13 relabellings of all and 8e7 of four.
TEST(TargetJudgement, SixteenDotsAreJudgedCompletely) {
  const TargetJudgement of_grid = judge(grid(4, 4), kSigma_m);
  EXPECT_TRUE(of_grid.complete);
  EXPECT_TRUE(of_grid.ambiguous());
  EXPECT_EQ(of_grid.dots_needed(), 17U);
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const TargetJudgement judgement = judge(random_target(16, seed), 0.005);
    EXPECT_TRUE(judgement.complete);
    EXPECT_FALSE(judgement.ambiguous());
    EXPECT_TRUE(judgement.few.relabelling.has_value());
  }
}

// A square of side a in its own plane: about its diagonals the inertia is a^2, about its normal
// twice that.
TEST(Conditioning, OfASquare) {
  const Conditioning at_its_middle = conditioning_of(
      target_of({{0.15, 0.15, 0}, {-0.15, 0.15, 0}, {-0.15, -0.15, 0}, {0.15, -0.15, 0}}));
  EXPECT_NEAR(at_its_middle.attitude_deg_per_mm, 0.180 / std::numbers::pi / 0.3, 1e-9);
  EXPECT_NEAR(at_its_middle.position_mm_per_mm, 0.5, 1e-9);
  const Conditioning above_the_origin = conditioning_of(grid(2, 2));
  EXPECT_EQ(above_the_origin.attitude_deg_per_mm, at_its_middle.attitude_deg_per_mm);
  EXPECT_GT(above_the_origin.position_mm_per_mm, 1.0);
}

TEST(Conditioning, DotsNearALineTellLittle) {
  const core::Target target = target_of({{0, 0, 0}, {0.3, 0.01, 0}, {0.7, 0, 0}, {1, 0.01, 0}});
  EXPECT_FALSE(judge(target, kSigma_m).well_conditioned());
  EXPECT_TRUE(judge(grid(2, 2), kSigma_m).well_conditioned());
}

struct Symmetric {
  std::string name;
  core::Target target;
  std::size_t moves = 1;
};

void PrintTo(const Symmetric& symmetric, std::ostream* out) {
  *out << symmetric.name;
}

std::vector<Symmetric> symmetric_targets() {
  core::Target turning_square = grid(2, 2);
  turning_square.upright = false;
  core::Target turning_grid = grid(3, 2);
  turning_grid.upright = false;
  const double high = std::sqrt(3.0) / 2.0;
  return {{"Square", grid(2, 2)},
          {"SquareThatTurnsOver", turning_square},
          {"Rectangle", grid(3, 2)},
          {"RectangleThatTurnsOver", turning_grid},
          {"Grid", grid(4, 4)},
          {"Triangle", target_of({{0, 0, 0.5}, {1, 0, 0.5}, {0.5, high, 0.5}})}};
}

class Moves : public testing::TestWithParam<Symmetric> {};

TEST_P(Moves, TellASymmetricTargetApart) {
  core::Target target = GetParam().target;
  ASSERT_TRUE(judge(target, kSigma_m).ambiguous());
  const std::vector<DotMove> moves = moves_to_tell_apart(target, kSigma_m);
  ASSERT_EQ(moves.size(), GetParam().moves);
  for (const DotMove& move : moves) {
    Vector3d& place = target.dots[move.dot].position_m;
    EXPECT_NEAR((move.to_m - place).norm(), move.by_m, 1e-12);
    EXPECT_NEAR(move.to_m.z(), place.z(), 1e-12) << "out of its plane";
    EXPECT_LT(move.by_m, 0.04);
    place = move.to_m;
  }
  EXPECT_FALSE(judge(target, kSigma_m).ambiguous());
}

INSTANTIATE_TEST_SUITE_P(Shapes, Moves, testing::ValuesIn(symmetric_targets()),
                         [](const auto& shape) { return shape.param.name; });

}  // namespace
}  // namespace dottrack::config
