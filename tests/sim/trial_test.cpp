// What a tick makes of a trial, without a scene to be rendered.

#include "app/workstation/trial.h"

#include <gtest/gtest.h>

namespace dottrack::workstation {
namespace {

using core::Reason;
using core::TickResult;

const TruePose kThere{{1.0, 2.0, 0.5}, Eigen::Quaterniond::Identity()};

core::Pose pose_off_by(double offset_m, double turn_deg = 0.0) {
  core::Pose pose;
  pose.position_m = kThere.position_m + Eigen::Vector3d(0.0, offset_m, 0.0);
  pose.orientation = Eigen::AngleAxisd(turn_deg * M_PI / 180.0, Eigen::Vector3d::UnitZ());
  return pose;
}

TickResult lock_at(const core::Pose& pose, std::uint64_t tick = 0) {
  TickResult result;
  result.tick = tick;
  result.reason = Reason::none;
  result.has_pose = true;
  result.pose = pose;
  result.false_lock_probability = 1e-9;
  result.has_candidate = true;
  result.candidate = pose;
  result.acquisition.false_lock_probability = 1e-9;
  result.acquisition.dots_matched = 5;
  result.acquisition.min_views = 3;
  return result;
}

TickResult without_lock(Reason reason) {
  TickResult result;
  result.reason = reason;
  return result;
}

TEST(TrialOutcome, IsRightWithinTheLimitsOfAWrongLock) {
  Trial trial;
  take(lock_at(pose_off_by(0.09, 4.5), 2), kThere, trial);
  EXPECT_EQ(trial.outcome, Outcome::right_lock);
  EXPECT_EQ(trial.lock_tick, 2);
  EXPECT_NEAR(trial.position_mm, 90.0, 1e-9);
  EXPECT_NEAR(trial.attitude_deg, 4.5, 1e-9);
  EXPECT_EQ(trial.lock_probability, 1e-9);
  EXPECT_EQ(trial.dots_matched, 5);
  EXPECT_EQ(trial.min_views, 3);
  ASSERT_TRUE(trial.candidate);
  EXPECT_TRUE(trial.candidate->right);
}

TEST(TrialOutcome, IsWrongBeyondThemAndWithoutAVehicle) {
  for (const core::Pose& pose : {pose_off_by(0.11), pose_off_by(0.0, 5.5)}) {
    Trial trial;
    take(lock_at(pose), kThere, trial);
    EXPECT_EQ(trial.outcome, Outcome::wrong_lock);
    EXPECT_TRUE(trial.locked());
    ASSERT_TRUE(trial.candidate);
    EXPECT_FALSE(trial.candidate->right);
  }
  Trial trial;
  take(lock_at(pose_off_by(0.0)), std::nullopt, trial);
  EXPECT_EQ(trial.outcome, Outcome::wrong_lock) << "there is no vehicle";
  EXPECT_FALSE(trial.candidate->right);
}

TEST(TrialOutcome, IsHeldBackWhenSomeTickFoundWhatItDidNotBelieve) {
  for (const Reason reason : {Reason::held_back, Reason::ambiguous}) {
    Trial trial;
    TickResult result = without_lock(reason);
    result.has_candidate = true;
    result.candidate = pose_off_by(0.5);
    result.acquisition.false_lock_probability = 0.3;
    take(result, kThere, trial);
    take(without_lock(Reason::no_matching_subset), kThere, trial);
    EXPECT_EQ(trial.outcome, Outcome::held_back);
    EXPECT_EQ(trial.reason, Reason::no_matching_subset);
    EXPECT_FALSE(trial.locked());
    ASSERT_TRUE(trial.candidate);
    EXPECT_EQ(trial.candidate->false_lock_probability, 0.3);
    EXPECT_FALSE(trial.candidate->right);
    take(lock_at(pose_off_by(0.0), 2), kThere, trial);
    EXPECT_EQ(trial.outcome, Outcome::right_lock) << "in the end";
    EXPECT_EQ(trial.candidate->false_lock_probability, 0.3) << "the first one's";
  }
}

TEST(TrialOutcome, IsNoneWhenNothingWasFound) {
  Trial trial;
  take(without_lock(Reason::too_few_finalists), kThere, trial);
  EXPECT_EQ(trial.outcome, Outcome::no_lock);
  EXPECT_EQ(trial.reason, Reason::too_few_finalists);
  EXPECT_FALSE(trial.candidate);
}

}  // namespace
}  // namespace dottrack::workstation
