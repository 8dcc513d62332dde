// Every value of a message against what a reader of the bus has of it.

#include "app/core/protocol/pose_message.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/protocol/dbc_reading.h"
#include "tests/unit/protocol/random_message.h"

namespace dottrack::protocol::test {
namespace {

constexpr double kDegreesPerRadian = 57.295779513082320877;
constexpr double kTiny = 1e-12;

class Pose : public testing::TestWithParam<bool> {
 protected:
  static bool is_fd() { return GetParam(); }
  static Addressing addressing() { return is_fd() ? fd() : classic(); }
  // The classic message, which FdPose stands for.
  static std::string of(const std::string& message, const std::string& signal) {
    return (is_fd() ? "FdPose" : message) + "." + signal;
  }
};

TEST_P(Pose, PositionIsWithinHalfAStep) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 5000; ++i) {
    const PoseMessage sent = random_message(random);
    const Reading got(encoded(sent, addressing(), {}));
    ASSERT_NEAR(got(of("Position", "X")), sent.position_m.x(), 0.00005 + kTiny);
    ASSERT_NEAR(got(of("Position", "Y")), sent.position_m.y(), 0.00005 + kTiny);
    ASSERT_NEAR(got(of("Position2", "Z")), sent.position_m.z(), 0.00005 + kTiny);
  }
}

TEST_P(Pose, RoundingTurnsTheAttitudeByLessThanFiveThousandthsOfADegree) {
  std::mt19937_64 random(2);
  double worst_deg = 0.0;
  PoseMessage sent;
  sent.pose_valid = true;
  const std::array<std::string, 4> names{of("Position2", "QW"), of("Orientation", "QX"),
                                         of("Orientation", "QY"), of("Orientation", "QZ")};
  for (int i = 0; i < 100000; ++i) {
    sent.orientation = random_orientation(random);
    const GroupFrames frames = encoded(sent, addressing(), {});
    Reading got;
    for (std::size_t f = is_fd() ? 0 : 4; f < frames.size(); ++f) got.add(frames[f]);
    Eigen::Quaterniond q(got(names[0]), got(names[1]), got(names[2]), got(names[3]));
    ASSERT_LE((q.coeffs() - sent.orientation.coeffs()).cwiseAbs().maxCoeff(), 0.0000155 + kTiny);
    q.normalize();
    worst_deg = std::max(worst_deg, sent.orientation.angularDistance(q) * kDegreesPerRadian);
  }
  EXPECT_LT(worst_deg, 0.005);
  EXPECT_GT(worst_deg, 0.001);  // half a step of each of four components makes 0.0036
}

TEST_P(Pose, TheSignOfTheQuaternionSurvives) {
  PoseMessage sent;
  sent.pose_valid = true;
  for (const double w : {-0.5, 0.5, -1.0, 1.0}) {
    const double rest = std::abs(w) == 1.0 ? 0.0 : w;
    sent.orientation = Eigen::Quaterniond(w, -rest, rest, -rest);
    const Reading got(encoded(sent, addressing(), {}));
    EXPECT_NEAR(got(of("Position2", "QW")), w, 0.0000155 + kTiny);
    EXPECT_NEAR(got(of("Orientation", "QX")), -rest, 0.0000155 + kTiny);
    EXPECT_NEAR(got(of("Orientation", "QY")), rest, 0.0000155 + kTiny);
    EXPECT_NEAR(got(of("Orientation", "QZ")), -rest, 0.0000155 + kTiny);
  }
}

TEST_P(Pose, StatusIsAsItWas) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 2000; ++i) {
    const PoseMessage sent = random_message(random);
    const Reading got(encoded(sent, addressing(), {}));
    ASSERT_EQ(got(of("Status", "Version")), kProtocolVersion);
    ASSERT_EQ(got(of("Status", "State")), static_cast<int>(sent.state));
    ASSERT_EQ(got(of("Status", "Reason")), static_cast<int>(sent.reason));
    ASSERT_EQ(got(of("Status", "PoseValid")), 1.0);
    ASSERT_EQ(got(of("Status", "OutOfRange")), 0.0);
    ASSERT_EQ(got(of("Status", "CamerasUsed")), sent.cameras_used.bits());
    ASSERT_EQ(got(of("Status", "DotsUsed")), sent.dots_used);
    ASSERT_EQ(got(of("Status", "PoseKind")), static_cast<int>(sent.kind));
    ASSERT_EQ(got(of("Status", "ResetCount")), sent.reset_count);
    ASSERT_EQ(got.raw(of("Quality", "Degraded")), sent.degraded.bits());
  }
}

TEST_P(Pose, TimeIsFlooredToMicrosecondsAndAgeIsRoundedUp) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 5000; ++i) {
    const PoseMessage sent = random_message(random);
    const Reading got(encoded(sent, addressing(), {}));
    const std::int64_t us = got.raw(of("Time", "MidExposure"));
    const std::int64_t truth_ns = sent.mid_exposure.time_since_epoch().count();
    ASSERT_EQ(us, (truth_ns / 1000) & ((std::int64_t{1} << 48) - 1));
    const Duration age = got.raw(of("Quality", "Age")) * std::chrono::microseconds(100);
    ASSERT_GE(age, sent.age);
    ASSERT_LT(age - sent.age, std::chrono::microseconds(100));
  }
}

TEST_P(Pose, ResidualAndFalseLockNeverUnderstate) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponent(-80.0, 0.0);
  for (int i = 0; i < 5000; ++i) {
    PoseMessage sent = random_message(random);
    sent.false_lock_probability = i % 2 == 0 ? std::exp2(exponent(random))
                                             : std::ldexp(1.0, -static_cast<int>(random() % 250));
    const Reading got(encoded(sent, addressing(), {}));
    const double residual = got(of("Position2", "Residual"));
    ASSERT_GE(residual, sent.residual_m);
    ASSERT_LT(residual, sent.residual_m + 0.00025 + kTiny);
    const double bound = std::exp2(-got(of("Quality", "FalseLock")));
    ASSERT_GE(bound, sent.false_lock_probability);
    ASSERT_LT(bound, 2.0 * sent.false_lock_probability);
  }
}

TEST_P(Pose, MotionIsWithinHalfAStep) {
  const GroupParts parts{.covariance = false, .motion = true, .cameras = false, .dots = false};
  std::mt19937_64 random(6);
  for (int i = 0; i < 3000; ++i) {
    const PoseMessage sent = random_message(random);
    const Reading got(encoded(sent, addressing(), parts));
    const Eigen::Vector3d v(got("Velocity.VX"), got("Velocity.VY"), got("Velocity.VZ"));
    const Eigen::Vector3d w(got("Rates.WX"), got("Rates.WY"), got("Rates.WZ"));
    ASSERT_LE((v - *sent.velocity_m_s).cwiseAbs().maxCoeff(), 0.0005 + kTiny);
    ASSERT_LE((w - *sent.rates_rad_s).cwiseAbs().maxCoeff(), 0.00025 + kTiny);
  }
}

TEST_P(Pose, EachDotAndEachCameraComesThrough) {
  std::mt19937_64 random(7);
  int seen = 0;
  for (int i = 0; i < 300; ++i) {
    PoseMessage sent = random_message(random);
    sent.dots_known = 16;
    const Reading got(encoded(sent, addressing()));
    for (std::size_t k = 0; k < core::kMaxDots; ++k) {
      const DotReport& dot = sent.dots[k];
      const std::string name = "Dot" + std::to_string(k + 1);
      ASSERT_EQ(got(name + "Detail.Visibility"), static_cast<int>(dot.visibility));
      ASSERT_EQ(got(name + "Detail.Cameras"), dot.cameras.bits());
      if (dot.visibility == Visibility::not_seen) continue;
      ++seen;
      ASSERT_NEAR(got(name + "Position.X"), dot.position_m.x(), 0.00005 + kTiny);
      ASSERT_NEAR(got(name + "Position.Y"), dot.position_m.y(), 0.00005 + kTiny);
      ASSERT_NEAR(got(name + "Detail.Z"), dot.position_m.z(), 0.00005 + kTiny);
      ASSERT_GE(got(name + "Detail.Sigma"), dot.sigma_m);
      ASSERT_LT(got(name + "Detail.Sigma"), dot.sigma_m + 0.0005 + kTiny);
    }
    for (std::size_t k = 0; k < kMaxCameras; ++k) {
      const std::string name = "Cameras.Camera" + std::to_string(k + 1);
      ASSERT_EQ(got(name), static_cast<int>(sent.cameras[k]));
    }
  }
  EXPECT_GT(seen, 2000);
}

INSTANTIATE_TEST_SUITE_P(ClassicAndFd, Pose, testing::Values(false, true));

}  // namespace
}  // namespace dottrack::protocol::test
