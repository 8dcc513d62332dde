// What a world is made of: arithmetic, random numbers, light plans, materials, target layouts.

#include <gtest/gtest.h>

#include <cmath>

#include "host_sim/world/lamp.h"
#include "host_sim/world/material.h"
#include "host_sim/world/outline.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"
#include "host_sim/world/rover.h"
#include "host_sim/world/target_layout.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

TEST(PortableMathTest, AgreesWithTheLibrary) {
  for (double x = -40.0; x < 40.0; x += 0.0137) {
    EXPECT_NEAR(sine(x), std::sin(x), 2e-15) << x;
    EXPECT_NEAR(cosine(x), std::cos(x), 2e-15) << x;
    EXPECT_NEAR(exponential(x) / std::exp(x), 1.0, 2e-15) << x;
  }
  EXPECT_NEAR(tangent(0.6), std::tan(0.6), 1e-15);
}

// The first numbers of a stream never change: scenes depend on them.
TEST(RandomStreamTest, IsAFixedSequence) {
  RandomStream random(1, 2);
  EXPECT_EQ(random.word(), 8460352000482166300ULL);
  RandomStream other(2, 2);
  EXPECT_NE(RandomStream(1, 2).word(), other.word());
}

TEST(RandomStreamTest, NoiseHasMeanZeroAndVarianceOne) {
  constexpr int kCount = 200000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const auto n = static_cast<std::uint64_t>(i);
    const double value = nearly_normal(mix(7, 2 * n), mix(7, 2 * n + 1));
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.01);
  EXPECT_NEAR(squares / kCount, 1.0, 0.015);
}

TEST(LightPlanTest, SwitchesAndFades) {
  LightPlan plan;
  plan.changes = {{"sun", 0.0, 0.0, 0.0},
                  {"fluorescent", 2.0, 0.2, 0.0},
                  {"sun", 3.0, 1.0, 4.0},
                  {"fluorescent_east", 5.0, 1.0, 1.0}};
  EXPECT_EQ(plan.level("sun", 2.9), 0.0);
  EXPECT_DOUBLE_EQ(plan.level("sun", 4.0), 0.25);
  EXPECT_DOUBLE_EQ(plan.level("sun", 7.0), 1.0);
  EXPECT_EQ(plan.level("fluorescent_west", 1.999), 1.0);
  EXPECT_EQ(plan.level("fluorescent_west", 2.0), 0.2);
  EXPECT_EQ(plan.level("fluorescent_west", 9.0), 0.2);
  EXPECT_DOUBLE_EQ(plan.level("fluorescent_east", 5.5), 0.6);
  EXPECT_EQ(plan.level("fluorescent_east", 9.0), 1.0);
  EXPECT_EQ(plan.level("window", 9.0), 1.0);
}

TEST(LightPlanTest, WhatIsSaidOfTheStartHoldsFromTheStart) {
  LightPlan plan;
  plan.changes = {{"sun", 0.0, 0.3, 5.0}};
  EXPECT_EQ(plan.level("sun", 0.0), 0.3);
  EXPECT_EQ(plan.level("sun", -1.0), 0.3);
}

TEST(MaterialTest, PatternsKeepTheirMeanAndStayPossible) {
  for (const Pattern pattern :
       {Pattern::mottled, Pattern::planks, Pattern::sand, Pattern::concrete}) {
    const Material material{0.37, pattern, 0.0, 3};
    RandomStream random(5, 1);
    double sum = 0.0;
    for (int i = 0; i < 4000; ++i) {
      const Eigen::Vector3d p{random.uniform(-9.0, 9.0), random.uniform(-4.0, 4.0),
                              random.uniform(0.0, 2.0)};
      const double albedo = albedo_at(material, p, 0.01);
      ASSERT_GT(albedo, 0.05);
      ASSERT_LT(albedo, 0.75);
      sum += albedo;
    }
    EXPECT_NEAR(sum / 4000.0, 0.37, 0.025) << static_cast<int>(pattern);
  }
}

TEST(MaterialTest, ASolarPanelIsDarkUnderItsDots) {
  const Material cells{0.06, Pattern::cells, 0.25, 3};
  for (double x = -0.6; x < 0.6; x += 0.0071) {
    EXPECT_LT(albedo_at(cells, {x, 0.3 * x, 0.52}, 0.012), 0.25 * kDotAlbedo) << x;
  }
}

TEST(MaterialTest, ReliefIsSmallAndLevelOnAverage) {
  const Material sand{0.37, Pattern::sand, 0.0, 3};
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double steepest = 1.0;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d p(0.0371 * i - 70.0, 0.0113 * i - 20.0, 0.0);
    const Eigen::Vector3d n = relief_normal(sand, p, Eigen::Vector3d::UnitZ());
    ASSERT_NEAR(n.norm(), 1.0, 1e-12);
    steepest = std::min(steepest, n.z());
    mean += n / 4000.0;
  }
  EXPECT_LT(mean.head<2>().norm(), 0.02);
  EXPECT_GT(steepest, std::cos(radians(35.0)));
  EXPECT_LT(steepest, std::cos(radians(10.0)));
}

TEST(TargetLayoutTest, TheDemosIsUnlikeItself) {
  EXPECT_GT(distinctness_m(demo_layout()), 0.05);
}

TEST(TargetLayoutTest, ASymmetricalOneIsFoundOut) {
  TargetLayout square;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) square.push_back({{x, y, 0.5}, 0.1, Vector3d::UnitZ()});
  }
  EXPECT_LT(distinctness_m(square), 1e-12);
}

TEST(TargetLayoutTest, RandomOnesHaveAllTheirDotsApartAndAreUnlikeThemselves) {
  for (int dots = 3; dots <= 16; ++dots) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const TargetLayout layout = random_layout(dots, seed);
      ASSERT_EQ(layout.size(), static_cast<std::size_t>(dots)) << seed;
      EXPECT_GE(distinctness_m(layout), 0.03) << dots << " dots, seed " << seed;
      for (std::size_t i = 0; i < layout.size(); ++i) {
        const Eigen::Vector2d p = layout[i].centre_m.head<2>();
        EXPECT_EQ(layout[i].centre_m.z(), kDeckHeight_m);
        EXPECT_TRUE(inside(deck_outline(), p));
        EXPECT_GT(distance_to_edge(deck_outline(), p), 0.5 * layout[i].diameter_m + 0.03);
        for (std::size_t j = 0; j < i; ++j) {
          EXPECT_GT((layout[i].centre_m - layout[j].centre_m).norm(), 1.5 * layout[i].diameter_m);
        }
      }
    }
  }
}

}  // namespace
}  // namespace dottrack::host_sim
