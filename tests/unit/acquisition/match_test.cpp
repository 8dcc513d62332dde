#include "app/core/acquisition/match.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/unit/acquisition/synthetic_views.h"

namespace dottrack::acquisition {
namespace {

using Eigen::Vector3d;

constexpr double kDiameter_m = 0.1;
constexpr std::uint64_t kPlenty = 1'000'000'000;

class MatchTest : public testing::Test {
 protected:
  void see(const std::vector<Vector3d>& points, double noise_px = 0.1) {
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      test::see(cameras_[i], points, kDiameter_m, noise_px, random_, (*views_)[i]);
    }
  }
  std::span<const CameraView> views() const { return *views_; }

  std::mt19937 random_{5};
  std::vector<core::Camera> cameras_ = test::ceiling_cameras();
  std::unique_ptr<std::vector<CameraView>> views_ =
      std::make_unique<std::vector<CameraView>>(cameras_.size());
  Matcher matcher_;
  std::unique_ptr<CandidatePairs> pairs_ = std::make_unique<CandidatePairs>();
};

TEST_F(MatchTest, CountsWhatEachGateRefused) {
  see(test::points_in_room(100, random_));
  core::AcquisitionCounts counts;
  pairs_->clear();
  WorkBudget budget(kPlenty);
  matcher_.match(views(), 0, 1, kDiameter_m, *pairs_, counts, budget);
  EXPECT_EQ(counts.pairs_tested, counts.rejected_collinear + counts.rejected_behind +
                                     counts.rejected_distance + counts.rejected_miss +
                                     counts.rejected_size + counts.rejected_reprojection +
                                     counts.pairs_accepted);
  EXPECT_GT(counts.pairs_accepted, 0U);
  EXPECT_LT(counts.pairs_accepted, counts.pairs_tested);
}

TEST_F(MatchTest, StopsAtItsBudget) {
  see(test::points_in_room(100, random_));
  core::AcquisitionCounts counts;
  WorkBudget budget(150);
  matcher_.match(views(), 0, 1, kDiameter_m, *pairs_, counts, budget);
  EXPECT_TRUE(budget.exhausted());
  EXPECT_LE(counts.pairs_tested, 50U);
}

TEST_F(MatchTest, CamerasAtOnePlaceFormNoPairs) {
  cameras_[1] = cameras_[0];
  see(test::points_in_room(20, random_));
  core::AcquisitionCounts counts;
  WorkBudget budget(kPlenty);
  matcher_.match(views(), 0, 1, kDiameter_m, *pairs_, counts, budget);
  EXPECT_TRUE(pairs_->empty());
}

TEST_F(MatchTest, EachGateRefusesWhatItIsThereFor) {
  const std::vector<Vector3d> point = {{4.0, 3.0, 0.5}};
  see(point, 0.0);
  CandidatePair pair;
  auto& views = *views_;
  ASSERT_EQ(test_pair(views[0], 0, views[1], 0, kDiameter_m, pair), PairGate::accepted);
  EXPECT_LT((pair.point_m - point[0]).norm(), 1e-9);

  auto changed = std::make_unique<CameraView>(views[0]);
  changed->sightings[0].line.ray = views[1].sightings[0].line.ray;
  EXPECT_EQ(test_pair(*changed, 0, views[1], 0, kDiameter_m, pair), PairGate::collinear);

  *changed = views[0];
  changed->sightings[0].line.ray.direction *= -1.0;
  EXPECT_EQ(test_pair(*changed, 0, views[1], 0, kDiameter_m, pair), PairGate::behind);

  core::Camera near_sighted = cameras_[0];
  near_sighted.distance_max_m = 3.0;
  *changed = views[0];
  changed->camera = &near_sighted;
  EXPECT_EQ(test_pair(*changed, 0, views[1], 0, kDiameter_m, pair), PairGate::distance);

  *changed = views[0];
  changed->sightings[0].line.ray.origin.z() += 0.5;
  EXPECT_EQ(test_pair(*changed, 0, views[1], 0, kDiameter_m, pair), PairGate::miss);

  *changed = views[0];
  changed->sightings[0].window = {9.0, 12.0};
  EXPECT_EQ(test_pair(*changed, 0, views[1], 0, kDiameter_m, pair), PairGate::size);

  *changed = views[0];
  changed->sightings[0].box_min_px.x() += 10.0;
  changed->sightings[0].box_max_px.x() += 10.0;
  EXPECT_EQ(test_pair(*changed, 0, views[1], 0, kDiameter_m, pair), PairGate::reprojection);
}

}  // namespace
}  // namespace dottrack::acquisition
