// Rest and sudden motion, which ask for the opposite of one another: at rest the filtered pose
// jitters far less than the raw one, and at a step in speed it lags by less than a tick.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/estimation/motion_drive.h"

namespace dottrack::estimation {
namespace {

using Eigen::Vector3d;

const core::MotionLimits kLimits;
constexpr double kSigmasOfRawPose_m[] = {0.3e-3, 1e-3, 3e-3};
constexpr double kRates_hz[] = {10.0, 30.0, 100.0};

struct Jitter {
  double raw = 0.0;
  double filtered = 0.0;
  Consistency consistency;
  double smallest_sigma_m = 1.0;
  double ratio() const { return std::sqrt(raw / filtered); }
};

// Of positions and of rotations, from the second second on: before that there is little to average.
struct Jitters {
  Jitter position;
  Jitter rotation;
};

Jitters jitters_at_rest(double sigma_m, double rate_hz) {
  Jitters sum;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    MovingVehicle vehicle(kLimits, seed);
    vehicle.keep(MotionModel::at_rest);
    vehicle.hold_still();
    // Four cameras of four coordinates each: the raw pose has about the sigma of one coordinate.
    Drive<MovingVehicle> drive(
        kLimits, vehicle,
        {.rate_hz = rate_hz, .sigma_m = 2.0 * sigma_m, .synchronised = true, .seed = 50 + seed});
    while (drive.ticks < 8.0 * rate_hz) {
      drive.tick();
      if (drive.ticks < rate_hz) continue;
      const MotionState& state = drive.filter.last();
      const core::Pose raw = pose_from(drive.raw);
      MotionState raw_state;
      raw_state.position_m = raw.position_m;
      raw_state.orientation = raw.orientation;
      const Vector12d raw_error = error_of(raw_state, drive.vehicle.truth());
      const Vector12d error = error_of(state, drive.vehicle.truth());
      sum.position.raw += raw_error.head<3>().squaredNorm();
      sum.position.filtered += error.head<3>().squaredNorm();
      sum.rotation.raw += raw_error.segment<3>(3).squaredNorm();
      sum.rotation.filtered += error.segment<3>(3).squaredNorm();
      sum.position.smallest_sigma_m =
          std::min(sum.position.smallest_sigma_m,
                   std::sqrt(state.covariance.diagonal().head<3>().minCoeff()));
      sum.position.consistency.add(normalised_squared_error(state, drive.vehicle.truth()));
    }
  }
  return sum;
}

// Measured: position 4.4 to 12, rotation 4.8 to 12 times below raw.
TEST(FilterAtRest, JittersThreeTimesLessThanTheRawPose) {
  for (const double sigma_m : kSigmasOfRawPose_m) {
    for (const double rate_hz : kRates_hz) {
      const Jitters jitters = jitters_at_rest(sigma_m, rate_hz);
      EXPECT_GT(jitters.position.ratio(), 3.5) << sigma_m << " m, " << rate_hz << " Hz";
      EXPECT_GT(jitters.rotation.ratio(), 3.5) << sigma_m << " m, " << rate_hz << " Hz";
    }
  }
}

// Held exactly still, more than anything real: the filter must not believe in less than a tremor.
TEST(FilterAtRest, IsNeverSurerThanItMayBe) {
  for (const double sigma_m : kSigmasOfRawPose_m) {
    for (const double rate_hz : kRates_hz) {
      const Jitter jitter = jitters_at_rest(sigma_m, rate_hz).position;
      EXPECT_GT(jitter.consistency.samples(), 500);
      EXPECT_LT(jitter.consistency.mean(), 6.0);
      EXPECT_GT(jitter.consistency.part_inside(), 0.95);
      EXPECT_GT(jitter.smallest_sigma_m, 0.02e-3);
    }
  }
}

// At rest, then from one tick to the next at a speed; the step falls into the middle of a tick.
class SteppingVehicle {
 public:
  SteppingVehicle(const Vector3d& velocity_m_s, double step_at_s)
      : velocity_m_s_(velocity_m_s), step_at_s_(step_at_s) {}
  void advance_to(double time_s) {
    const bool moves = time_s > step_at_s_;
    truth_.velocity_m_s = moves ? velocity_m_s_ : Vector3d::Zero();
    if (moves) truth_.position_m = (time_s - step_at_s_) * velocity_m_s_;
  }
  const Truth& truth() const { return truth_; }

 private:
  Vector3d velocity_m_s_;
  double step_at_s_;
  Truth truth_;
};

struct Lag {
  double worst_ticks = 0.0;  // of single runs, single ticks
  double mean_ticks = 0.0;   // the worst of the ticks' means over all runs
  int jumps = 0;
};

// The lag: how far the filtered position is behind the true one along the motion, in the motion's
// way of one tick.
Lag lag_after_step(double speed_m_s, double sigma_m, double rate_hz) {
  constexpr int kRuns = 40;
  constexpr int kTicks = 15;
  std::array<double, kTicks> sums{};
  Lag lag;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    Random random(seed);
    const Vector3d direction = normal_vector(random, 1.0).normalized();
    const int rest_ticks = static_cast<int>(2.0 * rate_hz);
    Drive<SteppingVehicle> drive(
        kLimits, SteppingVehicle(speed_m_s * direction, 1.0 + (rest_ticks + 0.5) / rate_hz),
        {.rate_hz = rate_hz, .sigma_m = 2.0 * sigma_m, .synchronised = true, .seed = 70 + seed});
    for (int i = 0; i < rest_ticks; ++i) drive.tick();
    for (double& sum : sums) {
      lag.jumps += drive.tick().jumped ? 1 : 0;
      const Vector3d behind = drive.vehicle.truth().position_m - drive.filter.last().position_m;
      const double ticks = behind.dot(direction) / (speed_m_s / rate_hz);
      lag.worst_ticks = std::max(lag.worst_ticks, ticks);
      sum += ticks / kRuns;
    }
  }
  lag.mean_ticks = *std::max_element(sums.begin(), sums.end());
  return lag;
}

// Where the vehicle's way of one tick is five times the raw pose's sigma or more: no filter can
// tell a smaller one from noise within a tick and average noise at rest as well.
TEST(FilterAtAStepInSpeed, LagsByLessThanATick) {
  int steps = 0;
  for (const double sigma_m : kSigmasOfRawPose_m) {
    for (const double rate_hz : kRates_hz) {
      for (const double speed_m_s : {0.1, 0.5, 1.0, 1.9}) {
        if (speed_m_s / rate_hz < 5.0 * sigma_m) continue;
        const Lag lag = lag_after_step(speed_m_s, sigma_m, rate_hz);
        EXPECT_LT(lag.worst_ticks, 1.0)
            << speed_m_s << " m/s, " << sigma_m << " m, " << rate_hz << " Hz";
        EXPECT_LT(lag.mean_ticks, 0.5)
            << speed_m_s << " m/s, " << sigma_m << " m, " << rate_hz << " Hz";
        EXPECT_EQ(lag.jumps, 0);
        ++steps;
      }
    }
  }
  EXPECT_GE(steps, 20);
}

}  // namespace
}  // namespace dottrack::estimation
