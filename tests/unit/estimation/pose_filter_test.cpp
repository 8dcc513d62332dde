#include "app/core/estimation/pose_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/unit/estimation/motion_drive.h"

namespace dottrack::estimation {
namespace {

using Eigen::Vector3d;

const core::MotionLimits kLimits;

MovingVehicle resting(std::uint64_t seed) {
  MovingVehicle vehicle(kLimits, seed);
  vehicle.keep(MotionModel::at_rest);
  vehicle.hold_still();
  return vehicle;
}

// A drive after so many ticks.
Drive<MovingVehicle> driven(const MovingVehicle& vehicle, const DriveSettings& settings,
                            int ticks) {
  Drive<MovingVehicle> drive(kLimits, vehicle, settings);
  for (int i = 0; i < ticks; ++i) drive.tick();
  return drive;
}

bool same_bits(const MotionState& a, const MotionState& b) {
  return a.position_m == b.position_m && a.orientation.coeffs() == b.orientation.coeffs() &&
         a.velocity_m_s == b.velocity_m_s && a.rates_rad_s == b.rates_rad_s &&
         a.covariance == b.covariance && a.at == b.at;
}

// The views as they would be of a vehicle that stands elsewhere.
PoseInformation shifted(PoseInformation views, const Vector3d& by_m) {
  views.position_m += by_m;
  return views;
}

TEST(PoseFilter, StartsAtThePoseWithAnySpeedWithinTheLimits) {
  PoseFilter filter(kLimits);
  EXPECT_FALSE(filter.running());
  core::Pose pose;
  pose.position_m = {1.0, 2.0, 3.0};
  pose.covariance = 1e-6 * Matrix6d::Identity();
  filter.start(pose, time_at(2.0));
  ASSERT_TRUE(filter.running());
  EXPECT_EQ(filter.last().position_m, pose.position_m);
  EXPECT_EQ(filter.last().velocity_m_s, Vector3d::Zero());
  EXPECT_NEAR(std::sqrt(filter.last().covariance(6, 6)), 0.5 * kLimits.max_speed_m_s, 1e-12);
  EXPECT_NEAR(std::sqrt(filter.last().covariance(9, 9)), 0.5 * kLimits.max_turn_rate_rad_s, 1e-12);
  filter.stop();
  EXPECT_FALSE(filter.running());
}

TEST(PoseFilter, FindsVelocityAndRatesOfASteadyVehicle) {
  MovingVehicle vehicle(kLimits, 3);
  vehicle.keep(MotionModel::driven);
  vehicle.advance_to(0.9);
  vehicle.keep(MotionModel::steady);
  const auto drive = driven(vehicle, {.seed = 4}, 30);
  const Vector12d error = error_of(drive.filter.last(), drive.vehicle.truth());
  EXPECT_GT(drive.vehicle.truth().velocity_m_s.norm(), 0.2);
  EXPECT_GT(drive.vehicle.truth().rates_rad_s.norm(), 0.2);
  EXPECT_LT(error.segment<3>(6).norm(), 0.01);
  EXPECT_LT(error.segment<3>(9).norm(), 0.02);
  const core::Motion motion = motion_of(drive.filter.last());
  EXPECT_TRUE(motion.known);
  EXPECT_EQ(motion.velocity_m_s, drive.filter.last().velocity_m_s);
  EXPECT_EQ(motion.rates_rad_s, drive.filter.last().rates_rad_s);
}

TEST(PoseFilter, TakesTheCamerasOfATickInAnyOrder) {
  auto drive = driven(MovingVehicle(kLimits, 5), {.seed = 6}, 40);
  PoseFilter other = drive.filter;
  drive.tick();
  std::vector<PoseInformation> backwards(drive.views.rbegin(), drive.views.rend());
  EXPECT_EQ(other.update(backwards).accepted.size(), 4);
  EXPECT_TRUE(same_bits(other.last(), drive.filter.last()));
}

TEST(PoseFilter, GivesTheSameBitsAgain) {
  const auto first = driven(MovingVehicle(kLimits, 7), {.seed = 8}, 100);
  const auto second = driven(MovingVehicle(kLimits, 7), {.seed = 8}, 100);
  EXPECT_TRUE(same_bits(first.filter.last(), second.filter.last()));
}

TEST(PoseFilter, KeepsItsCovarianceSymmetricAndPositive) {
  int looked_at = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    auto drive = driven(MovingVehicle(kLimits, 30 + seed), {.coordinates = 2, .seed = seed}, 0);
    for (int i = 0; i < 200; ++i) {
      drive.tick();
      const Matrix12d& p = drive.filter.last().covariance;
      ASSERT_EQ(p, Matrix12d(p.transpose()));
      ASSERT_GT(Eigen::SelfAdjointEigenSolver<Matrix12d>(p).eigenvalues().minCoeff(), 0.0);
      ++looked_at;
    }
  }
  EXPECT_EQ(looked_at, 2000);
}

TEST(PoseFilter, PredictsWithoutChangingAnything) {
  const auto drive = driven(MovingVehicle(kLimits, 9), {.seed = 10}, 50);
  const MotionState before = drive.filter.last();
  double last = before.covariance.topLeftCorner<6, 6>().determinant();
  for (int ms = 5; ms <= 1000; ms += 5) {
    const Time later = before.at + std::chrono::milliseconds(ms);
    const MotionState state = drive.filter.at(later);
    const double now = state.covariance.topLeftCorner<6, 6>().determinant();
    EXPECT_EQ(state.at, later);
    EXPECT_GT(now, last) << ms;
    last = now;
  }
  EXPECT_TRUE(same_bits(drive.filter.last(), before));
  EXPECT_TRUE(same_bits(drive.filter.at(before.at), before));
}

TEST(PoseFilter, FollowsTheMotionBackwards) {
  MovingVehicle vehicle(kLimits, 11);
  vehicle.keep(MotionModel::steady);
  auto drive = driven(vehicle, {.synchronised = true, .seed = 12}, 60);
  const Truth before = drive.vehicle.truth();
  const Time then = time_at(drive.now_s);
  drive.tick();
  EXPECT_LT(error_of(drive.filter.at(then), before).head<3>().norm(), 0.001);
}

TEST(PoseFilter, CarriesLateViewsOn) {
  MovingVehicle vehicle(kLimits, 13);
  vehicle.keep(MotionModel::driven);
  vehicle.advance_to(0.95);
  vehicle.keep(MotionModel::steady);
  auto drive = driven(vehicle, {.synchronised = true, .seed = 14}, 60);
  Random random(15);
  const Truth earlier = drive.vehicle.truth();
  const Time then = time_at(drive.now_s);
  drive.tick();
  const double travel_m = (drive.vehicle.truth().position_m - earlier.position_m).norm();
  ASSERT_GT(travel_m, 0.003);
  const PoseInformation late = look(earlier, then, 12, 0.0002, random);
  EXPECT_EQ(drive.filter.update({&late, 1}).accepted.size(), 1);
  EXPECT_EQ(drive.filter.last().at, time_at(drive.now_s));
  EXPECT_LT(error_of(drive.filter.last(), drive.vehicle.truth()).head<3>().norm(), 0.001);
}

TEST(PoseFilter, LeavesOutACameraThatContradictsTheOthers) {
  int left_out = 0;
  int others_kept = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    auto drive = driven(MovingVehicle(kLimits, seed), {.coordinates = 6, .seed = seed}, 45);
    PoseFilter filter = drive.filter;
    drive.tick();
    const std::size_t bad = seed % 4;
    drive.views[bad] = shifted(drive.views[bad], 0.03 * Vector3d(1.0, -1.0, 1.0));
    const UpdateResult result = filter.update(drive.views);
    ASSERT_FALSE(result.jumped);
    left_out += result.accepted.contains(bad) ? 0 : 1;
    others_kept += result.accepted.size() - (result.accepted.contains(bad) ? 1 : 0);
    EXPECT_GT(result.surprise[bad], largest_surprise(6));
    EXPECT_LT(error_of(filter.last(), drive.vehicle.truth()).head<3>().norm(), 0.008);
  }
  EXPECT_GE(left_out, 98);      // 100
  EXPECT_GE(others_kept, 290);  // of 300
}

TEST(PoseFilter, LeavesOutFiguresThatAreNone) {
  auto drive = driven(resting(1), {.seed = 16}, 20);
  PoseFilter filter = drive.filter;
  drive.tick();
  drive.views[2].gradient[3] = std::numeric_limits<double>::quiet_NaN();
  drive.views[3].information(1, 1) = std::numeric_limits<double>::infinity();
  const UpdateResult result = filter.update(drive.views);
  EXPECT_EQ(result.accepted, CameraSet::first(2));
  EXPECT_TRUE(filter.last().covariance.allFinite());
}

TEST(PoseFilter, CallsAJumpAJumpAndNeverSmearsIt) {
  for (const double far_m : {0.3, 1.0, 5.0}) {
    auto drive = driven(resting(2), {.sigma_m = 0.002, .seed = 17}, 60);
    PoseFilter filter = drive.filter;
    drive.tick();
    for (PoseInformation& views : drive.views) views = shifted(views, {far_m, 0.0, 0.0});
    const UpdateResult result = filter.update(drive.views);
    EXPECT_TRUE(result.jumped) << far_m;
    EXPECT_TRUE(result.accepted.empty());
    EXPECT_LT((filter.last().position_m - drive.vehicle.truth().position_m).norm(), 0.001);
  }
}

TEST(PoseFilter, BelievesMostCamerasThatSeeAJump) {
  auto drive = driven(resting(3), {.coordinates = 6, .seed = 18}, 60);
  PoseFilter filter = drive.filter;
  drive.tick();
  for (std::size_t i = 1; i < 4; ++i) drive.views[i] = shifted(drive.views[i], {0.0, 0.8, 0.0});
  EXPECT_TRUE(filter.update(drive.views).jumped);
}

TEST(PoseFilter, DoesNotCallAVehiclesStartAJump) {
  int ticks = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    MovingVehicle vehicle = resting(seed);
    vehicle.advance_to(2.0);
    auto drive = driven(vehicle, {.seed = seed}, 30);
    drive.vehicle.keep(MotionModel::driven);
    for (int i = 0; i < 30; ++i, ++ticks) {
      const UpdateResult result = drive.tick();
      ASSERT_FALSE(result.jumped);
      ASSERT_GE(result.accepted.size(), 3);
    }
  }
  EXPECT_EQ(ticks, 900);
}

TEST(PoseFilter, IsBackAtTheVehicleTwoTicksAfterHalfASecondInTheDark) {
  int runs = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed, ++runs) {
    MovingVehicle vehicle(kLimits, 200 + seed);
    vehicle.keep(MotionModel::driven);
    auto drive = driven(vehicle, {.synchronised = true, .seed = seed}, 45);
    drive.ticks += 15;
    drive.tick();
    const UpdateResult second = drive.tick();
    EXPECT_FALSE(second.jumped);
    EXPECT_EQ(second.accepted.size(), 4);
    EXPECT_LT(error_of(drive.filter.last(), drive.vehicle.truth()).head<3>().norm(), 0.006) << seed;
  }
  EXPECT_EQ(runs, 60);
}

}  // namespace
}  // namespace dottrack::estimation
