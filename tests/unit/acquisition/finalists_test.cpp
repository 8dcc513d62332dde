#include "app/core/acquisition/finalists.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "app/core/acquisition/refine.h"
#include "tests/unit/acquisition/synthetic_views.h"

namespace dottrack::acquisition {
namespace {

using Eigen::Vector3d;

constexpr double kDiameter_m = 0.1;

class FinalistsTest : public testing::Test {
 protected:
  void see(const std::vector<Vector3d>& points, double noise_px) {
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      test::see(cameras_[i], points, kDiameter_m, noise_px, random_, (*views_)[i]);
    }
  }

  const Finalists& merge_all() {
    merger_->start(2.0 * kDiameter_m);
    for (std::size_t a = 0; a < cameras_.size(); ++a) {
      for (std::size_t b = a + 1; b < cameras_.size(); ++b) {
        pairs_->clear();
        matcher_.match(*views_, a, b, kDiameter_m, *pairs_, counts_, budget_);
        for (const CandidatePair& pair : *pairs_) merger_->merge(*views_, pair, counts_, budget_);
      }
    }
    return merger_->finalists();
  }

  std::mt19937 random_{6};
  std::vector<core::Camera> cameras_ = test::ceiling_cameras();
  std::unique_ptr<std::vector<CameraView>> views_ =
      std::make_unique<std::vector<CameraView>>(cameras_.size());
  Matcher matcher_;
  std::unique_ptr<CandidatePairs> pairs_ = std::make_unique<CandidatePairs>();
  std::unique_ptr<FinalistMerger> merger_ = std::make_unique<FinalistMerger>();
  core::AcquisitionCounts counts_;
  WorkBudget budget_{1'000'000'000};
};

TEST_F(FinalistsTest, ADotSeenByAllCamerasIsOneFinalist) {
  see({{4.0, 3.0, 0.3}}, 0.1);
  const Finalists& merged = merge_all();
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_EQ(merged[0].cameras.size(), 5);
  EXPECT_EQ(merged[0].pairs, 10U);
  merger_->refine(*views_, budget_);
  ASSERT_EQ(merger_->finalists().size(), 1U);
  const Finalist& finalist = merger_->finalists()[0];
  EXPECT_LT((finalist.position_m - Vector3d(4.0, 3.0, 0.3)).norm(), 0.005);
  EXPECT_NEAR(finalist.diameter_m, kDiameter_m, 0.01);
  EXPECT_GT(finalist.covariance_m2.trace(), 0.0);
}

TEST_F(FinalistsTest, EveryDotOfManyIsFoundWithAllItsViews) {
  int dots = 0;
  int whole = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const auto points = test::points_in_room(30, random_);
    see(points, 0.15);
    merge_all();
    merger_->refine(*views_, budget_);
    for (const Vector3d& point : points) {
      int visible = 0;
      for (const CameraView& view : *views_) {
        for (const auto& s : view.sightings) {
          Eigen::Vector2d pixel;
          geometry::project(view.camera->model, point, pixel);
          visible += (pixel - s.pixel).norm() < 0.8;
        }
      }
      if (visible < 2) continue;
      ++dots;
      for (const Finalist& f : merger_->finalists()) {
        if ((f.position_m - point).norm() > 0.01 || f.cameras.size() < visible) continue;
        ++whole;
        break;
      }
    }
  }
  EXPECT_GT(dots, 400);
  EXPECT_GE(whole, dots * 97 / 100);  // some regions of a few dots coincide in a view
}

TEST_F(FinalistsTest, NoViewIsListedTwiceAndNoneIsLeftAlone) {
  see(test::points_in_room(60, random_), 0.2);
  merge_all();
  merger_->refine(*views_, budget_);
  std::set<std::vector<int>> seen;
  for (const Finalist& f : merger_->finalists()) {
    EXPECT_GE(f.cameras.size(), 2);
    std::vector<int> key;
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      key.push_back(f.cameras.contains(c) ? f.sighting[c] : -1);
    }
    EXPECT_TRUE(seen.insert(key).second) << "two finalists with the same views";
  }
  EXPECT_GT(seen.size(), 50U);
}

TEST_F(FinalistsTest, AViewThatDisagreesIsDropped) {
  see({{4.0, 3.0, 0.3}}, 0.0);
  auto& odd = (*views_)[2].sightings[0];
  const Vector3d away = Vector3d(0.0, 0.0, 1.0);
  odd.line.ray.direction = (odd.line.ray.direction + 0.02 * away).normalized();
  odd.pixel.x() += 12.0;
  odd.box_min_px.x() += 12.0;
  odd.box_max_px.x() += 12.0;
  merger_->start(2.0 * kDiameter_m);
  Finalist finalist;
  for (std::size_t c = 0; c < 5; ++c) finalist.cameras.insert(c);
  ASSERT_TRUE(refine_finalist(*views_, finalist));
  EXPECT_FALSE(finalist.cameras.contains(2));
  EXPECT_EQ(finalist.cameras.size(), 4);
  EXPECT_LT((finalist.position_m - Vector3d(4.0, 3.0, 0.3)).norm(), 1e-9);
}

TEST_F(FinalistsTest, TwoRegionsOfOneCameraNeverJoinOneFinalist) {
  see({{4.0, 3.0, 0.3}, {4.02, 3.01, 0.3}}, 0.0);
  merge_all();
  merger_->refine(*views_, budget_);
  EXPECT_GE(merger_->finalists().size(), 2U);
}

TEST(PointGrid, VisitsEveryPointWithinTheRadius) {
  auto grid = std::make_unique<PointGrid>();
  constexpr double kRadius = 0.2;
  grid->clear(kRadius);
  std::mt19937 random(8);
  std::vector<Vector3d> points = test::points_in_room(3000, random);
  for (std::size_t i = 0; i < points.size(); ++i)
    grid->insert(static_cast<std::uint16_t>(i), points[i]);
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const Vector3d to = points[i] + Vector3d(shift(random), shift(random), shift(random));
    grid->move(static_cast<std::uint16_t>(i), points[i], to);
    points[i] = to;
  }
  std::size_t near = 0;
  for (const Vector3d& place : test::points_in_room(500, random)) {
    std::multiset<std::uint16_t> visited;
    grid->visit_near(place, [&](std::uint16_t i) { visited.insert(i); });
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((points[i] - place).norm() > kRadius) continue;
      ++near;
      EXPECT_EQ(visited.count(static_cast<std::uint16_t>(i)), 1U);
    }
  }
  EXPECT_GT(near, 500U);
}

}  // namespace
}  // namespace dottrack::acquisition
