// A vehicle that stands still: what the views' errors have in common from tick to tick, the filter
// must not average away.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "app/core/tracking/motion_estimator.h"
#include "tests/unit/estimation/room_of_dots.h"

namespace dottrack::tracking {
namespace {

using estimation::DotObservations;
using estimation::test::RoomOfDots;

constexpr double kSigma_px = 0.03;
constexpr int kTicks = 20;
constexpr int kVehicles = 500;
constexpr Duration kTick = std::chrono::milliseconds(100);

struct Means {
  double nees = 0.0;      // of the filter's pose after kTicks
  double raw_nees = 0.0;  // of the last tick's own
  double share = 0.0;     // variance of the filter's x over the raw pose's
};

class StandingStillTest : public testing::Test {
 protected:
  // Their errors have the variance that they say; so much of it is the same in every tick.
  DotObservations see(const DotObservations& exact, const DotObservations& lasting, double part) {
    DotObservations views = lasting;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const Eigen::Vector2d stays = lasting[i].centre_px - exact[i].centre_px;
      const Eigen::Vector2d anew =
          estimation::test::random_error(views[i].covariance_px2, room_.random);
      views[i].centre_px =
          exact[i].centre_px + std::sqrt(part) * stays + std::sqrt(1.0 - part) * anew;
    }
    return views;
  }

  Means means(double part) {
    Means sum;
    for (int i = 0; i < kVehicles; ++i) add_vehicle(part, sum);
    return {sum.nees / kVehicles, sum.raw_nees / kVehicles, sum.share / kVehicles};
  }

  RoomOfDots room_;

 private:
  void add_vehicle(double part, Means& sum) {
    const geometry::RigidMotion truth = room_.somewhere();
    const DotObservations exact = room_.see(truth, 0.0);
    const DotObservations lasting = room_.see(truth, kSigma_px);
    estimation::PoseFitter fitter(room_.rig);
    estimation::PoseFit fit;
    MotionEstimator motion(room_.rig);
    std::array<core::CameraFrame, kMaxCameras> frames{};
    Time at{};
    for (int tick = 0; tick < kTicks; ++tick) {
      at += kTick;
      for (core::CameraFrame& frame : frames) frame.mid_exposure = at;
      const DotObservations views = see(exact, lasting, part);
      ASSERT_EQ(
          fitter.fit(as_span(views), {}, room_.near(truth), estimation::DotSpread::none(), fit),
          estimation::PoseFitStatus::ok);
      ASSERT_TRUE(motion.take_in(frames, fit, at));
    }
    const core::Pose filtered = motion.filtered(at).pose;
    sum.nees += estimation::test::nees(filtered, truth);
    sum.raw_nees += estimation::test::nees(fit.pose, truth);
    sum.share += filtered.covariance(0, 0) / fit.pose.covariance(0, 0);
  }
};

// Noise that is new in every tick: the mean of twenty knows far more than each. The filter, which
// is not told that the vehicle rests, is careful.
TEST_F(StandingStillTest, NewErrorsAverageOut) {
  const Means found = means(0.0);
  EXPECT_NEAR(found.raw_nees, 6.0, 0.6);
  EXPECT_GT(found.nees, 3.3);
  EXPECT_LT(found.nees, 6.6);
  EXPECT_LT(found.share, 0.2);
}

TEST_F(StandingStillTest, LastingErrorsDoNot) {
  for (const double part : {0.5, 0.8, 0.95}) {
    const Means found = means(part);
    EXPECT_NEAR(found.raw_nees, 6.0, 0.6) << part;
    EXPECT_NEAR(found.nees, 6.0, 0.9) << part;
    EXPECT_GT(found.share, 0.8 * part) << part;
    EXPECT_LT(found.share, 1.05) << part;
  }
}

}  // namespace
}  // namespace dottrack::tracking
