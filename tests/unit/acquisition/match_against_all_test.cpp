// Matching against the testing of every pair of sightings, one by one.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <limits>
#include <memory>
#include <vector>

#include "app/core/acquisition/match.h"
#include "tests/unit/acquisition/edge_pairs.h"
#include "tests/unit/acquisition/synthetic_views.h"

namespace dottrack::acquisition {
namespace {

using Eigen::Vector3d;

constexpr double kDiameter_m = 0.1;
constexpr std::uint64_t kPlenty = 1'000'000'000;

std::vector<CandidatePair> all_accepted(std::span<const CameraView> views, std::size_t a,
                                        std::size_t b, double max_miss_m) {
  std::vector<CandidatePair> accepted;
  CandidatePair pair;
  pair.camera = {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)};
  for (std::size_t i = 0; i < views[a].sightings.size(); ++i) {
    for (std::size_t j = 0; j < views[b].sightings.size(); ++j) {
      if (test_pair(views[a], i, views[b], j, max_miss_m, pair) == PairGate::accepted) {
        accepted.push_back(pair);
      }
    }
  }
  return accepted;
}

// The same pairs in the same order, and the same bits.
::testing::AssertionResult same(std::span<const CandidatePair> found,
                                std::span<const CandidatePair> expected) {
  for (std::size_t k = 0; k < std::min(found.size(), expected.size()); ++k) {
    if (found[k].camera == expected[k].camera && found[k].sighting == expected[k].sighting &&
        found[k].point_m == expected[k].point_m) {
      continue;
    }
    return ::testing::AssertionFailure()
           << "pair " << k << " is " << found[k].sighting[0] << "-" << found[k].sighting[1]
           << ", not " << expected[k].sighting[0] << "-" << expected[k].sighting[1];
  }
  if (found.size() == expected.size()) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << found.size() << " pairs, not " << expected.size();
}

class MatchAgainstAllTest : public testing::Test {
 protected:
  // Returns how many were accepted.
  std::size_t compare(std::span<const CameraView> views, std::size_t a, std::size_t b,
                      double max_miss_m) {
    pairs_->clear();
    WorkBudget budget(kPlenty);
    matcher_->match(views, a, b, max_miss_m, *pairs_, counts_, budget);
    const std::vector<CandidatePair> expected = all_accepted(views, a, b, max_miss_m);
    EXPECT_TRUE(same(as_span(*pairs_), expected));
    return expected.size();
  }

  std::unique_ptr<Matcher> matcher_ = std::make_unique<Matcher>();
  std::unique_ptr<CandidatePairs> pairs_ = std::make_unique<CandidatePairs>();
  core::AcquisitionCounts counts_;
};

TEST_F(MatchAgainstAllTest, PairsAtTheEdgeOfEveryGateAreFound) {
  std::size_t belong = 0;
  std::size_t accepted = 0;
  for (std::uint32_t seed = 0; seed < 600 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const test::EdgePairs rig(30, seed);
    compare(rig.views(), 0, 1, rig.max_miss_m());
    compare(rig.views(), 1, 0, rig.max_miss_m());
    belong += rig.views()[0].sightings.size();
    CandidatePair pair;
    for (std::size_t k = 0; k < rig.views()[0].sightings.size(); ++k) {
      accepted += test_pair(rig.views()[0], k, rig.views()[1], k, rig.max_miss_m(), pair) ==
                  PairGate::accepted;
    }
  }
  EXPECT_GT(belong, 15'000U);
  EXPECT_GT(accepted, belong * 9 / 10);
}

TEST_F(MatchAgainstAllTest, TheRoomsPairsAreFoundAndFewOthersTested) {
  const std::vector<core::Camera> cameras = test::ceiling_cameras();
  std::vector<CameraView> views(cameras.size());
  std::mt19937 random(5);
  std::size_t accepted = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const std::vector<Vector3d> points = test::points_in_room(60, random);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      test::see(cameras[i], points, kDiameter_m, 0.1, random, views[i]);
    }
    for (std::size_t a = 0; a < cameras.size(); ++a) {
      for (std::size_t b = a + 1; b < cameras.size(); ++b) {
        accepted += compare(views, a, b, kDiameter_m);
      }
    }
  }
  EXPECT_GT(accepted, 2000U);
  EXPECT_EQ(counts_.pairs_accepted, accepted);
  EXPECT_LT(counts_.pairs_tested, accepted * 3 / 2);
}

// A lens of any of the three kinds, with much distortion and a pupil that moves by centimetres.
core::Camera any_camera(const Vector3d& place, const Vector3d& towards, int kind) {
  core::Camera camera = test::ceiling_camera(place, towards);
  camera.distance_min_m = 0.3;
  const auto cahv = std::get<geometry::Cahv>(camera.model);
  if (kind == 1) {
    geometry::Cahvor model;
    model.c = cahv.c;
    model.a = model.o = cahv.a;
    model.h = cahv.h;
    model.v = cahv.v;
    model.r = {0.0, -0.05, 0.01};
    camera.model = model;
  } else if (kind == 2) {
    geometry::Cahvore model;
    model.c = cahv.c;
    model.a = model.o = cahv.a;
    model.h = cahv.h;
    model.v = cahv.v;
    model.r = {0.0, -0.02, 0.0};
    model.e = {0.02, 0.05, 0.0};
    camera.model = model;
  }
  return camera;
}

TEST_F(MatchAgainstAllTest, AnyLensesAnywhereFindThePairsOfAll) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  const auto vector = [&](double x, double y, double z) -> Vector3d {
    return {x * part(random), y * part(random), z * part(random)};
  };
  std::size_t accepted = 0;
  std::size_t offset = 0;
  for (int trial = 0; trial < 150 && !HasFailure(); ++trial) {
    SCOPED_TRACE(trial);
    // Side by side, or anywhere: then one often sees the other.
    const Vector3d first = vector(4.0, 4.0, 2.0);
    const double apart = trial % 3 == 0 ? 0.03 : 4.0;
    const std::vector<core::Camera> cameras = {
        any_camera(first, vector(1.0, 1.0, 1.0), trial % 3),
        any_camera(first + vector(apart, apart, apart), vector(1.0, 1.0, 1.0), trial % 2 + 1)};
    std::vector<Vector3d> points;
    for (int k = 0; k < 100; ++k) points.push_back(vector(4.0, 4.0, 2.0));
    for (int k = 0; k < 10; ++k) {
      const double along = part(random);
      points.push_back(along * geometry::centre(cameras[0].model) +
                       (1.0 - along) * geometry::centre(cameras[1].model) +
                       vector(0.05, 0.05, 0.05));
    }
    std::vector<CameraView> views(2);
    for (std::size_t i = 0; i < 2; ++i) {
      test::see(cameras[i], points, kDiameter_m, 0.3, random, views[i]);
      for (const auto& s : views[i].sightings) {
        offset += (s.line.ray.origin - geometry::centre(cameras[i].model)).norm() > 1e-3;
      }
    }
    accepted += compare(views, 0, 1, kDiameter_m) + compare(views, 1, 0, kDiameter_m);
  }
  EXPECT_GT(accepted, 5000U);
  EXPECT_GT(offset, 1000U);
}

TEST_F(MatchAgainstAllTest, InSlicesOfAnySizeTheResultIsTheSame) {
  const std::vector<core::Camera> cameras = test::ceiling_cameras();
  std::vector<CameraView> views(2);
  std::mt19937 random(3);
  const std::vector<Vector3d> points = test::points_in_room(200, random);
  for (std::size_t i = 0; i < 2; ++i) {
    test::see(cameras[i], points, kDiameter_m, 0.1, random, views[i]);
  }
  compare(views, 0, 1, kDiameter_m);
  const std::vector<CandidatePair> expected(pairs_->begin(), pairs_->end());
  ASSERT_GT(expected.size(), 100U);
  for (const std::uint64_t units : {0U, 1U, 50U, 300U}) {
    core::AcquisitionCounts counts;
    pairs_->clear();
    matcher_->start();
    std::size_t next = 0;
    std::size_t slices = 1;
    for (;; ++slices) {
      WorkBudget budget(units);
      const std::size_t before = next;
      if (matcher_->match(views, 0, 1, kDiameter_m, *pairs_, counts, budget, next)) break;
      ASSERT_TRUE(budget.exhausted());
      ASSERT_GT(next, before);
    }
    EXPECT_GT(slices, 3U);
    EXPECT_TRUE(same(as_span(*pairs_), expected));
    EXPECT_EQ(counts.pairs_tested, counts_.pairs_tested);
    EXPECT_EQ(counts.pairs_accepted, counts_.pairs_accepted);
  }
}

TEST_F(MatchAgainstAllTest, ABrokenSightingSpoilsNoOther) {
  const test::EdgePairs rig(100, 4);
  std::vector<CameraView> views(rig.views().begin(), rig.views().end());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  views[0].sightings[3].line.ray.direction.setConstant(nan);
  views[1].sightings[5].window.near_m = nan;
  views[0].sightings[7].window = {2.0, 1.0};
  views[1].sightings[9].pixels_per_rad.setConstant(nan);
  views[1].sightings[11].pixels_per_rad.setZero();
  EXPECT_GT(compare(views, 0, 1, rig.max_miss_m()), 80U);
}

TEST_F(MatchAgainstAllTest, NoBudgetNoWork) {
  const test::EdgePairs rig(10, 1);
  WorkBudget budget(0);
  budget.spend(1);
  std::size_t next = 0;
  matcher_->start();
  EXPECT_FALSE(matcher_->match(rig.views(), 0, 1, kDiameter_m, *pairs_, counts_, budget, next));
  EXPECT_EQ(next, 0U);
  EXPECT_EQ(counts_.pairs_tested, 0U);
}

TEST_F(MatchAgainstAllTest, EveryInstructionSetDoesTheSameWork) {
  const test::EdgePairs rig(500, 12);
  std::vector<std::uint64_t> units;
  std::vector<std::uint32_t> tested;
  std::vector<CandidatePair> expected;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    pairs_->clear();
    core::AcquisitionCounts counts;
    WorkBudget budget(kPlenty);
    matcher_->match(rig.views(), 0, 1, rig.max_miss_m(), *pairs_, counts, budget);
    hwy::SetSupportedTargetsForTest(0);
    if (expected.empty()) expected.assign(pairs_->begin(), pairs_->end());
    EXPECT_TRUE(same(as_span(*pairs_), expected));
    units.push_back(budget.spent());
    tested.push_back(counts.pairs_tested);
    EXPECT_EQ(units.back(), units.front());
    EXPECT_EQ(tested.back(), tested.front());
  }
  EXPECT_GE(expected.size(), 400U);
  EXPECT_FALSE(units.empty());
}

}  // namespace
}  // namespace dottrack::acquisition
