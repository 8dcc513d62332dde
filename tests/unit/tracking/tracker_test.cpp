#include "app/core/tracker.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "app/core/tracking/follow.h"
#include "tests/unit/tracking/painted_room.h"

namespace dottrack::core {
namespace {

using test::PaintedRoom;

void expect_locked(const TickResult& result, const Pose& truth) {
  ASSERT_TRUE(result.has_pose) << to_string(result.reason);
  EXPECT_EQ(result.state, State::tracking);
  EXPECT_EQ(result.reason, Reason::none);
  EXPECT_LT(test::position_error_m(result, truth), 0.003);
  EXPECT_LT(test::attitude_error_deg(result, truth), 0.5);
}

class TrackerTest : public testing::Test {
 protected:
  void show(const Pose& pose) {
    room_.clear();
    room_.paint_vehicle(pose);
  }
  // Locks onto the vehicle standing in the middle.
  void lock() {
    show(middle_);
    expect_locked(tracker_.step(room_.frames()), middle_);
  }

  PaintedRoom room_;
  Pose middle_ = PaintedRoom::pose_at(4.0, 3.0, 0.3);
  Tracker tracker_{room_.rig};
};

TEST_F(TrackerTest, LocksAtTheFirstTickAnywhere) {
  int locks = 0;
  for (int i = 0; i < 30; ++i) {
    const Pose pose = PaintedRoom::pose_at(2.5 + 0.1 * i, 2.0 + 0.07 * i, 0.5 * i);
    room_.clear();
    room_.paint_vehicle(pose);
    room_.paint_clutter(20, static_cast<unsigned>(i));
    Tracker fresh(room_.rig);
    const TickResult& result = fresh.step(room_.frames());
    if (!result.has_pose) continue;
    ++locks;
    expect_locked(result, pose);
    EXPECT_EQ(result.reset_count, 1U);
  }
  EXPECT_GE(locks, 28);  // a disc of clutter may cover a dot
}

TEST_F(TrackerTest, FollowsAMovingVehicle) {
  lock();
  for (int i = 1; i <= 60; ++i) {
    const Pose pose = PaintedRoom::pose_at(4.0 + 0.02 * i, 3.0 + 0.01 * i, 0.3 + 0.01 * i);
    show(pose);
    const TickResult& result = tracker_.step(room_.frames());
    expect_locked(result, pose);
    EXPECT_EQ(result.tick, static_cast<std::uint64_t>(i));
    EXPECT_EQ(result.reset_count, 1U);
  }
}

TEST_F(TrackerTest, ASteadyTargetGivesASteadyPoseAndASmallCovariance) {
  lock();
  const TickResult first = tracker_.step(room_.frames());
  const TickResult& second = tracker_.step(room_.frames());
  EXPECT_EQ(first.pose.position_m, second.pose.position_m);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(second.pose.covariance);
  EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0);
  EXPECT_LT(std::sqrt(second.pose.covariance(0, 0)), 0.005);
  EXPECT_LT(std::sqrt(second.pose.covariance(5, 5)), 0.02);
}

TEST_F(TrackerTest, TellsHowTheVehicleMovesFromTheSecondTickOfALockOn) {
  lock();
  auto frames = room_.frames();
  EXPECT_FALSE(
      tracker_.step(frames).filtered.motion.known);  // the pictures are of the same instant
  show(PaintedRoom::pose_at(middle_.position_m.x() + 0.05, middle_.position_m.y(), 0.3));
  frames = room_.frames();
  for (CameraFrame& frame : frames) frame.mid_exposure += std::chrono::milliseconds(100);
  const TickResult& moved = tracker_.step(frames);
  ASSERT_TRUE(moved.has_pose);
  ASSERT_TRUE(moved.filtered.motion.known);
  EXPECT_NEAR(moved.filtered.motion.velocity_m_s.x(), 0.5, 0.05);
  EXPECT_NEAR(moved.filtered.motion.velocity_m_s.y(), 0.0, 0.05);
}

TEST_F(TrackerTest, ALockKeepsItsProbabilityOfBeingAWrongOne) {
  lock();
  const double at_lock = tracker_.step(room_.frames()).false_lock_probability;
  EXPECT_LT(at_lock, 0.01);
  EXPECT_EQ(tracker_.step(room_.frames()).false_lock_probability, at_lock);
  room_.clear();
  EXPECT_EQ(tracker_.step(room_.frames()).false_lock_probability, 1.0);
}

TEST_F(TrackerTest, ForgetsItsLockWhenToldAndLooksAnew) {
  lock();
  tracker_.forget();
  const TickResult& result = tracker_.step(room_.frames());
  expect_locked(result, middle_);
  EXPECT_EQ(result.reset_count, 2U);
  EXPECT_FALSE(result.filtered.motion.known);
}

TEST_F(TrackerTest, StaysOnTargetWhenADotIsHidden) {
  lock();
  room_.clear();
  for (const std::size_t dot : {0U, 1U, 3U}) room_.paint_dot(middle_, dot);
  const TickResult& result = tracker_.step(room_.frames());
  expect_locked(result, middle_);
  EXPECT_EQ(result.dots_used, 3);
  EXPECT_FALSE(result.dots[2].located);
}

TEST_F(TrackerTest, StaysOnTargetWhenCamerasAreHiddenOrGone) {
  lock();
  auto frames = room_.frames();
  frames[0].delivered = false;
  frames[3].delivered = false;
  const TickResult& result = tracker_.step(frames);
  expect_locked(result, middle_);
  EXPECT_FALSE(result.cameras[0].delivered);
  EXPECT_FALSE(result.cameras[3].used);
  EXPECT_EQ(result.cameras_used.size(), 3);
}

TEST_F(TrackerTest, ADotMayHideFromDifferentCameras) {
  lock();
  room_.clear();
  for (std::size_t camera = 0; camera < room_.rig.cameras.size(); ++camera) {
    for (std::size_t dot = 0; dot < 4; ++dot) {
      if ((camera + dot) % 3 != 0) room_.paint_dot_in(camera, middle_, dot);
    }
  }
  expect_locked(tracker_.step(room_.frames()), middle_);
}

TEST_F(TrackerTest, ADotThatOneCameraSeesCounts) {
  lock();
  room_.clear();
  for (const std::size_t dot : {0U, 1U}) room_.paint_dot(middle_, dot);
  room_.paint_dot_in(1, middle_, 2);
  const TickResult& result = tracker_.step(room_.frames());
  expect_locked(result, middle_);
  EXPECT_EQ(result.dots_used, 3);
  EXPECT_FALSE(result.dots[2].located);
  EXPECT_TRUE(result.dots[2].views[1].used);
}

TEST_F(TrackerTest, TwoDotsAreTooFew) {
  lock();
  room_.clear();
  for (const std::size_t dot : {0U, 1U}) room_.paint_dot(middle_, dot);
  const TickResult& result = tracker_.step(room_.frames());
  EXPECT_FALSE(result.has_pose);
  EXPECT_EQ(result.reason, Reason::too_few_dots);
  EXPECT_EQ(result.state, State::tracking);
}

TEST_F(TrackerTest, IsLostAfterTheConfiguredTicksAndAcquiresAgain) {
  lock();
  room_.clear();
  for (int i = 1; i <= room_.rig.limits.lost_after_ticks; ++i) {
    const TickResult& lost = tracker_.step(room_.frames());
    EXPECT_FALSE(lost.has_pose);
    EXPECT_EQ(lost.ticks_lost, static_cast<std::uint32_t>(i));
    EXPECT_EQ(lost.state,
              i < room_.rig.limits.lost_after_ticks ? State::tracking : State::acquiring);
  }
  const Pose elsewhere = PaintedRoom::pose_at(5.0, 2.2, 2.0);
  show(elsewhere);
  const TickResult& again = tracker_.step(room_.frames());
  expect_locked(again, elsewhere);
  EXPECT_EQ(again.reset_count, 2U);
  EXPECT_EQ(again.ticks_lost, 0U);
}

TEST_F(TrackerTest, AShortOcclusionIsBridgedWithoutANewLock) {
  lock();
  room_.clear();
  tracker_.step(room_.frames());
  tracker_.step(room_.frames());
  show(middle_);
  const TickResult& result = tracker_.step(room_.frames());
  expect_locked(result, middle_);
  EXPECT_EQ(result.reset_count, 1U);
}

TEST_F(TrackerTest, NoPoseIsGivenForATargetThatIsNotThere) {
  room_.clear();
  room_.paint_clutter(40, 3);
  for (int i = 0; i < 3; ++i) {
    const TickResult& result = tracker_.step(room_.frames());
    EXPECT_FALSE(result.has_pose);
    EXPECT_EQ(result.state, State::acquiring);
    EXPECT_NE(result.reason, Reason::none);
  }
}

TEST_F(TrackerTest, AMovedDotMakesTheResidualTooLarge) {
  Pose skewed = middle_;
  skewed.position_m.z() += 0.07;
  Rig strict = room_.rig;
  strict.limits.max_rms_residual_m = 0.005;
  Tracker tracker(strict);
  show(middle_);
  expect_locked(tracker.step(room_.frames()), middle_);
  room_.clear();
  for (const std::size_t dot : {0U, 1U, 2U}) room_.paint_dot(middle_, dot);
  room_.paint_dot(skewed, 3);
  const TickResult& result = tracker.step(room_.frames());
  EXPECT_FALSE(result.has_pose);
  EXPECT_EQ(result.reason, Reason::residual);
}

TEST_F(TrackerTest, AStepBeyondTheLimitIsRefused) {
  Rig slow = room_.rig;
  slow.target.max_step_m = 0.02;
  slow.limits.watch_every_ticks = 0;
  Tracker tracker(slow);
  show(middle_);
  expect_locked(tracker.step(room_.frames()), middle_);
  show(PaintedRoom::pose_at(4.035, 3.0, 0.3));
  const TickResult& result = tracker.step(room_.frames());
  EXPECT_FALSE(result.has_pose);
  EXPECT_EQ(result.reason, Reason::step_too_large);
}

TEST_F(TrackerTest, FramesThatAreNoUseHaveTheirReasons) {
  std::array<CameraFrame, kMaxCameras> none{};
  EXPECT_EQ(tracker_.step(none).reason, Reason::no_frames);
  auto one = room_.frames();
  for (std::size_t i = 1; i < one.size(); ++i) one[i].delivered = false;
  EXPECT_EQ(tracker_.step(one).reason, Reason::too_few_cameras);
  auto small = room_.frames();
  for (auto& frame : small) frame.image.width_px = 320;
  EXPECT_EQ(tracker_.step(small).reason, Reason::no_frames);
}

TEST_F(TrackerTest, BlackWhiteAndNoisyImagesGiveNoPose) {
  for (const int grey : {0, 20, 255}) {
    room_.clear(static_cast<std::uint8_t>(grey));
    const TickResult& result = tracker_.step(room_.frames());
    EXPECT_FALSE(result.has_pose);
    EXPECT_EQ(result.reason, Reason::too_few_regions) << grey;
  }
  for (unsigned seed = 0; seed < 3; ++seed) {
    room_.paint_noise(seed);
    const TickResult& result = tracker_.step(room_.frames());
    EXPECT_FALSE(result.has_pose);
    EXPECT_NE(result.reason, Reason::none);
  }
}

TEST_F(TrackerTest, TheSameFramesGiveTheSameBits) {
  Tracker other(room_.rig);
  for (int i = 0; i < 10; ++i) {
    room_.clear();
    room_.paint_vehicle(PaintedRoom::pose_at(3.5 + 0.02 * i, 3.0, 0.05 * i));
    room_.paint_clutter(15, 9);
    const TickResult& a = tracker_.step(room_.frames());
    const TickResult& b = other.step(room_.frames());
    ASSERT_TRUE(a.has_pose);
    EXPECT_EQ(a.pose.position_m, b.pose.position_m);
    EXPECT_EQ(a.pose.orientation.coeffs(), b.pose.orientation.coeffs());
    EXPECT_EQ(a.pose.covariance, b.pose.covariance);
  }
}

TEST_F(TrackerTest, TheQuaternionsSignIsContinuousThroughAFullTurn) {
  Eigen::Quaterniond before = Eigen::Quaterniond::Identity();
  int steps = 0;
  for (int i = 0; i <= 200; ++i) {
    const Pose pose = PaintedRoom::pose_at(4.0, 3.0, 0.04 * i);
    show(pose);
    const TickResult& result = tracker_.step(room_.frames());
    ASSERT_TRUE(result.has_pose);
    if (i > 0) {
      EXPECT_GT(before.dot(result.pose.orientation), 0.99);
    }
    before = result.pose.orientation;
    ++steps;
  }
  EXPECT_EQ(steps, 201);
}

TEST_F(TrackerTest, NoTwoDotsRestOnOneRegion) {
  // In every view dots 0 and 3 look at the same region: neither of them may be located by it.
  PaintedRoom crowded(5);
  Rig& rig = crowded.rig;
  rig.target.dots[3].position_m = rig.target.dots[0].position_m + Eigen::Vector3d(0.02, 0.0, 0.0);
  std::array<geometry::Optics, kMaxCameras> optics;
  std::array<image::Regions, kMaxCameras> considered;
  std::array<image::Regions*, kMaxCameras> considered_of{};
  for (std::size_t i = 0; i < kMaxCameras; ++i) considered_of[i] = &considered[i];
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    optics[i] = geometry::Optics(rig.cameras[i].model, 640, 480);
  }
  for (const std::size_t dot : {0U, 1U, 2U, 4U}) crowded.paint_dot(middle_, dot);
  image::Identifier identifier;
  tracking::Follower follower(rig, optics, identifier);
  const tracking::FollowResult& result = follower.follow(crowded.frames(), middle_, considered_of);
  EXPECT_EQ(result.reason, Reason::none);
  EXPECT_FALSE(result.dots[0].located);
  EXPECT_FALSE(result.dots[3].located);
  EXPECT_EQ(result.dots_used, 3);
}

TEST(TrackerTargets, OfFourToEightDotsLockAtOnce) {
  for (std::size_t dots = 4; dots <= 8; ++dots) {
    PaintedRoom room(dots);
    const Pose pose = PaintedRoom::pose_at(4.2, 2.8, 1.0);
    room.paint_vehicle(pose);
    Tracker tracker(room.rig);
    const TickResult& result = tracker.step(room.frames());
    expect_locked(result, pose);
    EXPECT_EQ(result.dots_used, dots);
  }
}

TEST(TrackerTargets, OfThreeDotsLockOnceTheyMove) {
  PaintedRoom room(3);
  Tracker tracker(room.rig);
  room.paint_vehicle(PaintedRoom::pose_at(4.2, 2.8, 1.0));
  const TickResult& doubtful = tracker.step(room.frames());
  EXPECT_EQ(doubtful.reason, Reason::held_back);
  EXPECT_TRUE(doubtful.has_candidate);
  EXPECT_LT(doubtful.acquisition.false_lock_probability, 1e-3);
  room.clear();
  const Pose moved = PaintedRoom::pose_at(4.26, 2.8, 1.0);
  room.paint_vehicle(moved);
  expect_locked(tracker.step(room.frames(Time{} + std::chrono::milliseconds(100))), moved);
}

// The others stay hidden, as in a shadow: what is seen of the three is weighed by itself.
TEST(TrackerTargets, OfWhichThreeDotsAreSeenLockOnceTheyMove) {
  PaintedRoom room(5);
  Tracker tracker(room.rig);
  const auto show = [&](const Pose& pose, int tick) -> const TickResult& {
    room.clear();
    for (const std::size_t dot : {0U, 2U, 3U}) room.paint_dot(pose, dot);
    room.paint_clutter(6, 12);
    return tracker.step(room.frames(Time{} + tick * std::chrono::milliseconds(100)));
  };
  const TickResult& doubtful = show(PaintedRoom::pose_at(4.0, 2.8, 1.0), 0);
  EXPECT_EQ(doubtful.reason, Reason::held_back);
  EXPECT_EQ(doubtful.acquisition.dots_matched, 3);
  EXPECT_GT(doubtful.acquisition.false_lock_probability, 1e-6);
  int tick = 1;
  for (; tick < 6; ++tick) {
    const Pose pose = PaintedRoom::pose_at(4.0 + 0.06 * tick, 2.8, 1.0);
    if (!show(pose, tick).has_pose) continue;
    expect_locked(show(pose, tick), pose);
    return;
  }
  FAIL() << "no lock in " << tick << " ticks";
}

// Camera 0 is frozen: it shows all dots where they were, and would be believed.
TEST_F(TrackerTest, APictureThatNoLongerChangesIsLeftOut) {
  lock();
  PaintedRoom frozen = room_;
  for (int i = 1; i <= 5; ++i) {
    const Pose pose = PaintedRoom::pose_at(4.0 + 0.03 * i, 3.0, 0.3);
    show(pose);
    auto frames = room_.frames();
    frames[0] = frozen.frames()[0];
    const TickResult& result = tracker_.step(frames);
    expect_locked(result, pose);
    EXPECT_TRUE(result.cameras[0].stale) << i;
    EXPECT_FALSE(result.cameras[0].used) << i;
    EXPECT_FALSE(result.cameras[1].stale) << i;
  }
  const Pose pose = PaintedRoom::pose_at(4.18, 3.0, 0.3);
  show(pose);
  const TickResult& result = tracker_.step(room_.frames());
  expect_locked(result, pose);
  EXPECT_TRUE(result.cameras[0].used);
}

// A still recording that is shown for a while says nothing about its cameras.
TEST_F(TrackerTest, WhenNoPictureChangesNoneIsLeftOut) {
  lock();
  for (int i = 0; i < 3; ++i) {
    const TickResult& result = tracker_.step(room_.frames());
    expect_locked(result, middle_);
    EXPECT_FALSE(result.cameras[0].stale);
  }
}

}  // namespace
}  // namespace dottrack::core
