// Dots that are flat discs with a known normal (paper section 3.3).

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "app/core/estimation/dot_ellipse.h"
#include "app/core/tracking/ellipse_evidence.h"
#include "app/core/tracking/follow.h"
#include "tests/unit/tracking/flat_dots.h"

namespace dottrack::tracking {
namespace {

using test::FlatDots;

class FollowEllipseTest : public testing::Test {
 protected:
  FollowEllipseTest() {
    for (std::size_t i = 0; i < kMaxCameras; ++i) {
      regions_[i] = std::make_unique<image::Regions>();
      region_pointers_[i] = regions_[i].get();
    }
  }

  FollowResult follow(const core::Pose& previous) {
    Follower follower(room_.rig, room_.optics, identifier_);
    return follower.follow(room_.frames(), previous, region_pointers_);
  }

  static void expect_followed(const FollowResult& result, const core::Pose& truth) {
    ASSERT_EQ(result.reason, core::Reason::none) << core::to_string(result.reason);
    EXPECT_LT((result.pose.position_m - truth.position_m).norm(), 0.003);
    EXPECT_LT(result.pose.orientation.angularDistance(truth.orientation), 0.01);
  }

  static unsigned rejected(const FollowResult& result) {
    unsigned sum = 0;
    for (const std::uint32_t n : result.rejected_ellipse) sum += n;
    return sum;
  }

  static int views(const FollowResult& result) {
    int sum = 0;
    for (const core::DotState& dot : result.dots) {
      for (const core::DotView& view : dot.views) sum += view.used ? 1 : 0;
    }
    return sum;
  }

  Eigen::Vector3d place_of(std::size_t dot, const core::Pose& pose) const {
    return pose.orientation * room_.rig.target.dots[dot].position_m + pose.position_m;
  }

  // Paints one camera's picture anew, with one dot leaning another way.
  void paint_leaning(std::size_t camera, std::size_t dot, const Eigen::Vector3d& normal) {
    room_.clear(camera);
    for (std::size_t d = 0; d < room_.rig.target.dots.size(); ++d) {
      if (d != dot) room_.paint_dot(camera, d, here_);
    }
    room_.paint_disc(camera, place_of(dot, here_), normal);
  }

  FlatDots room_;
  core::Pose here_ = FlatDots::pose_at(4.0, 3.0, 0.3);
  core::Pose before_ = FlatDots::pose_at(3.97, 3.02, 0.27);
  image::Identifier identifier_;
  std::array<std::unique_ptr<image::Regions>, kMaxCameras> regions_;
  std::array<image::Regions*, kMaxCameras> region_pointers_{};
};

TEST_F(FollowEllipseTest, FollowsFlatDotsWhicheverWayTheyLean) {
  for (const Eigen::Vector3d& normal :
       {Eigen::Vector3d(0.0, 0.0, 1.0), Eigen::Vector3d(0.5, 0.0, 1.0),
        Eigen::Vector3d(-0.3, 0.6, 1.0)}) {
    room_.lean(normal);
    room_.paint(here_);
    const FollowResult result = follow(before_);
    expect_followed(result, here_);
    EXPECT_EQ(rejected(result), 0U);
    EXPECT_GE(views(result), 17);
    EXPECT_EQ(result.dots_used, 4);
  }
}

TEST_F(FollowEllipseTest, WithoutNormalsNothingIsRefused) {
  room_.paint(here_);
  const FollowResult with = follow(before_);
  for (core::TargetDot& dot : room_.rig.target.dots) dot.normal.reset();
  const FollowResult without = follow(before_);
  expect_followed(without, here_);
  // The middle of a disc's outline is not where its centre is shown: only normals tell how far off.
  EXPECT_LT((with.pose.position_m - here_.position_m).norm(), 0.0002);
  EXPECT_LT((with.pose.position_m - without.pose.position_m).norm(), 0.001);
  EXPECT_EQ(views(with), views(without));
  EXPECT_EQ(ellipse_log_odds_of(room_.rig, without.pose, without), 0.0);
}

TEST_F(FollowEllipseTest, ARegionOfAnotherShapeIsRefusedAndCounted) {
  // Camera 1 sees dot 2 as a disc that faces it, twice as high as one that lies flat.
  const Eigen::Vector3d to_camera =
      (geometry::centre(room_.rig.cameras[1].model) - place_of(2, here_)).normalized();
  const Eigen::Vector3d across = to_camera.cross(Eigen::Vector3d::UnitZ()).normalized();
  room_.paint(here_);
  paint_leaning(1, 2, (0.25 * to_camera + across).normalized());
  const FollowResult result = follow(before_);
  expect_followed(result, here_);
  EXPECT_EQ(result.rejected_ellipse[1], 1U);
  EXPECT_EQ(rejected(result), 1U);
  EXPECT_FALSE(result.dots[2].views[1].used);
  EXPECT_TRUE(result.dots[2].located);
}

TEST_F(FollowEllipseTest, DoesNotLookForDotsThatTurnAway) {
  room_.paint(here_);
  room_.lean(-Eigen::Vector3d::UnitZ());
  const FollowResult result = follow(before_);
  EXPECT_EQ(result.reason, core::Reason::too_few_dots);
  for (const auto& regions : regions_) EXPECT_TRUE(regions->empty());
}

// The vehicle has turned, so that a region which might have been the dot before may not be it now.
TEST_F(FollowEllipseTest, ARegionThatContradictsThePoseFoundIsDroppedAfterwards) {
  constexpr std::size_t kCamera = 1;
  constexpr std::size_t kDot = 2;
  room_.lean({0.7, 0.55, 0.45});
  room_.paint(here_);
  const core::Pose before = FlatDots::pose_at(4.0, 3.0, 0.3 - 0.1);
  const core::Camera& camera = room_.rig.cameras[kCamera];
  const auto expected_in = [&](const core::Pose& pose) {
    geometry::ImageEllipse ellipse;
    EXPECT_EQ(geometry::project_disc(camera.model, place_of(kDot, pose),
                                     pose.orientation * *room_.rig.target.dots[kDot].normal,
                                     0.5 * FlatDots::kDiameter_m, ellipse),
              geometry::OpticsStatus::ok);
    return ellipse;
  };
  int dropped_afterwards = 0;
  int kept = 0;
  for (int i = -12; i <= 12; ++i) {
    const Eigen::Vector3d lean = Eigen::AngleAxisd(0.12 * i, Eigen::Vector3d::UnitZ()) *
                                 (here_.orientation * *room_.rig.target.dots[kDot].normal);
    paint_leaning(kCamera, kDot, lean);
    const FollowResult result = follow(before);
    expect_followed(result, here_);
    Eigen::Vector2d pixel;
    ASSERT_EQ(geometry::project(camera.model, place_of(kDot, here_), pixel),
              geometry::OpticsStatus::ok);
    for (const image::Region& region : *regions_[kCamera]) {
      if ((region.centroid_px - pixel).norm() > 2.0) continue;
      const geometry::ImageEllipse seen = estimation::ellipse_of(region);
      const bool could_be = estimation::may_be(expected_in(before), seen);
      const bool can_be = estimation::may_be(expected_in(here_), seen);
      EXPECT_EQ(result.dots[kDot].views[kCamera].used, could_be && can_be);
      kept += could_be && can_be ? 1 : 0;
      dropped_afterwards += could_be && !can_be ? 1 : 0;
      break;
    }
  }
  EXPECT_GE(kept, 5);
  EXPECT_GE(dropped_afterwards, 1);
}

TEST_F(FollowEllipseTest, TheEllipsesSpeakForTheRightPoseAndAgainstAWrongOne) {
  room_.lean({0.6, 0.0, 1.0});
  room_.paint(here_);
  const FollowResult right = follow(before_);
  expect_followed(right, here_);
  const double odds = ellipse_log_odds_of(room_.rig, right.pose, right);
  EXPECT_GT(odds, 6.0);
  EXPECT_LE(odds, 4 * kMostDotLogOdds);
  // The same places with the labels half a turn on: the dots would lean the other way.
  FollowResult wrong = right;
  std::swap(wrong.dots[0], wrong.dots[2]);
  std::swap(wrong.dots[1], wrong.dots[3]);
  core::Pose turned = right.pose;
  turned.orientation =
      Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()) * turned.orientation;
  EXPECT_LT(ellipse_log_odds_of(room_.rig, turned, wrong), -6.0);
}

}  // namespace
}  // namespace dottrack::tracking
