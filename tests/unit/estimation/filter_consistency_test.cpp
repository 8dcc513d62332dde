// Whether the filter's covariance is true: mean normalised squared errors of the pose, 6 for a true
// one, and how many poses lie in their 95 % ellipsoids.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <string>

#include "tests/unit/estimation/motion_drive.h"

namespace dottrack::estimation {
namespace {

const core::MotionLimits kLimits;
constexpr double kSigmasOfRawPose_m[] = {0.3e-3, 1e-3, 3e-3};
constexpr double kRates_hz[] = {10.0, 30.0, 100.0};
constexpr double kDrive_s = 20.0;

struct Found {
  Consistency now;
  Consistency motion;               // of velocity and rates
  Consistency half_a_second_later;  // without views
  int jumps = 0;
};

double motion_error(const MotionState& state, const Truth& truth) {
  const Vector6d error = error_of(state, truth).tail<6>();
  const Matrix6d covariance = state.covariance.bottomRightCorner<6, 6>();
  return error.dot(covariance.llt().solve(error));
}

void look_ahead(const Drive<MovingVehicle>& drive, Found& found) {
  MovingVehicle later = drive.vehicle;
  later.advance_to(drive.now_s + 0.5);
  found.half_a_second_later.add(
      normalised_squared_error(drive.filter.at(time_at(drive.now_s + 0.5)), later.truth()));
}

// Two poses of every second.
void follow(MovingVehicle vehicle, const DriveSettings& settings, Found& found) {
  Drive<MovingVehicle> drive(kLimits, std::move(vehicle), settings);
  const int every = static_cast<int>(0.5 * settings.rate_hz);
  while (drive.ticks < kDrive_s * settings.rate_hz) {
    found.jumps += drive.tick().jumped ? 1 : 0;
    if (drive.ticks % every != 0) continue;
    found.now.add(normalised_squared_error(drive.filter.last(), drive.vehicle.truth()));
    found.motion.add(motion_error(drive.filter.last(), drive.vehicle.truth()));
    look_ahead(drive, found);
  }
}

// Each raw noise and each rate in turn. Four cameras that are not synchronised and see a part of
// the pose each.
DriveSettings settings_of(std::size_t i) {
  return {.rate_hz = kRates_hz[i / 3 % 3],
          .sigma_m = 2.0 * kSigmasOfRawPose_m[i % 3],
          .seed = 1000 + i};
}

// Vehicles that rest, drive steadily, gently and hard, and brake to rest, about a second each.
// Measured over 30 240 poses of 756 such vehicles: mean 6.04, 94.8 % inside; over those of this
// test 6.06 and 95.0 %, without views for half a second 1.3 and 99.5 %.
TEST(FilterConsistency, HoldsOverRestSteadyDrivingTurningAndAcceleration) {
  Found found;
  for (std::size_t i = 0; i < 252; ++i) {
    follow(MovingVehicle(kLimits, 500 + i), settings_of(i), found);
  }
  RecordProperty("mean", std::to_string(found.now.mean()));
  EXPECT_GE(found.now.samples(), 10'000);
  EXPECT_NEAR(found.now.mean(), 6.0, found.now.band());
  EXPECT_GT(found.now.part_inside(), 0.94);
  EXPECT_LT(found.now.part_inside(), 0.96);
  // Of velocity and rates few are far out: a vehicle that has just started counts as one at rest.
  EXPECT_GT(found.motion.part_inside(), 0.94);
  EXPECT_LT(found.half_a_second_later.mean(), 6.0);
  EXPECT_GT(found.half_a_second_later.part_inside(), 0.95);
  EXPECT_EQ(found.jumps, 0);
}

// One way of moving all the time is not what the filter expects of a vehicle: it may be too careful
// then, never too sure.
TEST(FilterConsistency, IsNotTooSureOfAVehicleThatKeepsToOneWayOfMoving) {
  for (const auto model :
       {MotionModel::at_rest, MotionModel::steady, MotionModel::eased, MotionModel::driven}) {
    Found found;
    for (std::size_t i = 0; i < 18; ++i) {
      MovingVehicle vehicle(kLimits, 500 + i);
      vehicle.keep(model);
      follow(std::move(vehicle), settings_of(i), found);
    }
    const int which = static_cast<int>(model);
    EXPECT_GE(found.now.samples(), 700);
    EXPECT_LT(found.now.mean(), 6.3) << which;
    EXPECT_GT(found.now.part_inside(), 0.94) << which;
    EXPECT_LT(found.motion.mean(), 6.3) << which;
    EXPECT_LT(found.half_a_second_later.mean(), 6.3) << which;
    EXPECT_EQ(found.jumps, 0) << which;
  }
}

}  // namespace
}  // namespace dottrack::estimation
