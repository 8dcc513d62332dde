// A picture that shows something else where a dot should be.

#include <gtest/gtest.h>

#include <memory>

#include "tests/unit/tracking/painted_room.h"

namespace dottrack::core {
namespace {

using test::PaintedRoom;

constexpr std::size_t kDot = 2;

class WrongViewTest : public testing::Test {
 protected:
  WrongViewTest() {
    Rig strict = room_.rig;
    strict.limits.max_rms_residual_m = 0.005;
    tracker_ = std::make_unique<Tracker>(strict);
    room_.paint_vehicle(PaintedRoom::pose_at(3.99, 3.0, 0.3));  // no picture stays as it is
    EXPECT_TRUE(tracker_->step(room_.frames()).has_pose);
  }

  // All dots but one in all pictures; of that one, two cameras show what is `off_m` away from it in
  // the second.
  const TickResult& step_with(double off_m) {
    room_.clear();
    for (const std::size_t dot : {0U, 1U, 3U}) room_.paint_dot(truth_, dot);
    room_.paint_dot_in(0, truth_, kDot);
    Pose off = truth_;
    off.position_m.x() += off_m;
    room_.paint_dot_in(1, off, kDot);
    return tracker_->step(room_.frames());
  }

  PaintedRoom room_;
  Pose truth_ = PaintedRoom::pose_at(4.0, 3.0, 0.3);
  std::unique_ptr<Tracker> tracker_;
};

TEST_F(WrongViewTest, OneOfTwoDoesNotSpoilThePose) {
  const TickResult& result = step_with(0.06);
  ASSERT_TRUE(result.has_pose) << to_string(result.reason);
  EXPECT_EQ(result.views_left_out, 1);
  EXPECT_TRUE(result.dots[kDot].views[0].used);
  EXPECT_FALSE(result.dots[kDot].views[1].used);
  EXPECT_FALSE(result.dots[kDot].located);
  EXPECT_LT(test::position_error_m(result, truth_), 0.003);
  EXPECT_LT(result.pose.rms_residual_m, 0.005);
}

TEST_F(WrongViewTest, OfTwoRightOnesTheDotIsLocated) {
  const TickResult& result = step_with(0.0);
  ASSERT_TRUE(result.has_pose);
  EXPECT_EQ(result.views_left_out, 0);
  EXPECT_TRUE(result.dots[kDot].located);
}

}  // namespace
}  // namespace dottrack::core
