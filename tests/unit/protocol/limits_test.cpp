// What does not fit, is not known or makes no sense.

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/protocol/dbc_reading.h"
#include "tests/unit/protocol/random_message.h"

namespace dottrack::protocol::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kLargest_m = 838.8607;

PoseMessage valid_message() {
  std::mt19937_64 random(1);
  PoseMessage message = random_message(random);
  message.dots_known = 16;
  return message;
}

class Limits : public testing::TestWithParam<bool> {
 protected:
  static Addressing addressing() { return GetParam() ? fd() : classic(); }
  static Reading read(const PoseMessage& message) {
    return Reading(encoded(message, addressing()));
  }
  static std::string of(const std::string& message, const std::string& signal) {
    return (GetParam() ? "FdPose" : message) + "." + signal;
  }
  static double age_of(Duration age) {
    PoseMessage message = valid_message();
    message.age = age;
    const Reading got = read(message);
    const std::string name = of("Quality", "Age");
    return got.available(name) ? static_cast<double>(got.raw(name)) : -1.0;
  }
  static int false_lock_of(double probability) {
    PoseMessage message = valid_message();
    message.false_lock_probability = probability;
    return static_cast<int>(read(message).raw(of("Quality", "FalseLock")));
  }
  static int residual_of(double residual_m) {
    PoseMessage message = valid_message();
    message.residual_m = residual_m;
    return static_cast<int>(read(message).raw(of("Position2", "Residual")));
  }
};

std::int64_t marker_of(const dbc::DbcSignal& signal) {
  const auto top = std::int64_t{1} << (signal.length - (signal.is_signed ? 1U : 0U));
  return signal.is_signed ? -top : top - 1;
}

// Signals that say "not available" where their value table has that.
void expect_no_pose(const Reading& got) {
  int markers = 0;
  for (const auto& [name, decoded] : got.signals()) {
    const bool of_a_dot = name.starts_with("Dot");
    const auto& values = decoded.signal->values;
    const auto marker = values.find(marker_of(*decoded.signal));
    const bool can_say = marker != values.end() && marker->second == "not available";
    if (of_a_dot || !can_say || name.ends_with(".Age")) continue;
    ++markers;
    EXPECT_EQ(decoded.text, "not available") << name;
  }
  EXPECT_EQ(markers, 3 + 4 + 1 + 1 + 6 + 15 + 6);
}

TEST_P(Limits, WithoutAPoseAllThatDescribesItIsNotAvailable) {
  PoseMessage message = valid_message();
  message.pose_valid = false;
  const Reading got = read(message);
  expect_no_pose(got);
  EXPECT_EQ(got(of("Status", "PoseValid")), 0);
  EXPECT_EQ(got(of("Status", "OutOfRange")), 0);
  EXPECT_TRUE(got.available(of("Quality", "Age")));
  EXPECT_EQ(got.raw(of("Quality", "Degraded")), message.degraded.bits());
}

TEST_P(Limits, WithoutAPoseNothingOfAnOldOneIsOnTheBus) {
  PoseMessage one = valid_message();
  one.pose_valid = false;
  PoseMessage other = one;
  other.position_m += Eigen::Vector3d(1, 2, 3);
  other.orientation = other.orientation.conjugate();
  other.residual_m *= 0.5;
  other.false_lock_probability = 0.25;
  *other.covariance *= 0.5;
  *other.velocity_m_s *= 0.5;
  *other.rates_rad_s *= 0.5;
  const GroupFrames frames = encoded(one, addressing());
  const GroupFrames others = encoded(other, addressing());
  ASSERT_EQ(frames.size(), others.size());
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].data, others[i].data);
}

TEST_P(Limits, APoseThatDoesNotFitIsNoPoseAndSaysSo) {
  std::vector<PoseMessage> messages;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double value : {kLargest_m + 1e-6, -kLargest_m - 1e-6, 1e300, kNaN, kInf, -kInf}) {
      messages.push_back(valid_message());
      messages.back().position_m[axis] = value;
    }
  }
  for (int part = 0; part < 4; ++part) {
    for (const double value : {2.0, kNaN, kInf, -kInf, 1e300}) {
      messages.push_back(valid_message());
      messages.back().orientation.coeffs()[part] = value;
    }
  }
  messages.push_back(valid_message());
  messages.back().orientation.coeffs().setZero();
  for (const PoseMessage& message : messages) {
    const Reading got = read(message);
    expect_no_pose(got);
    EXPECT_EQ(got(of("Status", "PoseValid")), 0);
    EXPECT_EQ(got(of("Status", "OutOfRange")), 1);
  }
  EXPECT_EQ(messages.size(), 39U);
}

TEST_P(Limits, TheLargestPositionFits) {
  for (const double sign : {-1.0, 1.0}) {
    PoseMessage message = valid_message();
    message.position_m.setConstant(sign * kLargest_m);
    const Reading got = read(message);
    EXPECT_EQ(got(of("Status", "PoseValid")), 1);
    EXPECT_EQ(got.raw(of("Position", "X")), static_cast<int>(sign) * 8388607);
    EXPECT_EQ(got.raw(of("Position", "Y")), static_cast<int>(sign) * 8388607);
    EXPECT_EQ(got.raw(of("Position2", "Z")), static_cast<int>(sign) * 8388607);
  }
}

TEST_P(Limits, AgeIsRoundedUpAndEndsAtItsRange) {
  using std::chrono::microseconds;
  EXPECT_EQ(age_of(Duration(0)), 0);
  EXPECT_EQ(age_of(Duration(1)), 1);
  EXPECT_EQ(age_of(microseconds(100)), 1);
  EXPECT_EQ(age_of(microseconds(100) + Duration(1)), 2);
  EXPECT_EQ(age_of(Duration(-1)), 0);
  EXPECT_EQ(age_of(Duration::min()), 0);
  EXPECT_EQ(age_of(microseconds(6'553'400)), 65534);
  EXPECT_EQ(age_of(microseconds(6'553'400) + Duration(1)), -1);
  EXPECT_EQ(age_of(Duration::max()), -1);
}

TEST_P(Limits, FalseLockIsRoundedDownAndKnowsWhatIsNoProbability) {
  EXPECT_EQ(false_lock_of(1.0), 0);
  EXPECT_EQ(false_lock_of(std::nextafter(1.0, 0.0)), 0);
  EXPECT_EQ(false_lock_of(std::nextafter(0.5, 1.0)), 0);
  EXPECT_EQ(false_lock_of(0.5), 1);
  EXPECT_EQ(false_lock_of(std::nextafter(0.5, 0.0)), 1);
  EXPECT_EQ(false_lock_of(0x1p-254), 254);
  EXPECT_EQ(false_lock_of(0x1p-255), 254);
  EXPECT_EQ(false_lock_of(std::numeric_limits<double>::denorm_min()), 254);
  EXPECT_EQ(false_lock_of(0.0), 254);
  for (const double none : {kNaN, kInf, -kInf, 1.0 + 1e-12, -1e-300}) {
    EXPECT_EQ(false_lock_of(none), 255) << none;
  }
}

TEST_P(Limits, ResidualIsRoundedUpAndSaturates) {
  EXPECT_EQ(residual_of(0.0), 0);
  EXPECT_EQ(residual_of(1e-300), 1);
  EXPECT_EQ(residual_of(0.00025), 1);
  EXPECT_EQ(residual_of(0.0634), 254);
  EXPECT_EQ(residual_of(0.07), 254);
  EXPECT_EQ(residual_of(kInf), 254);
  EXPECT_EQ(residual_of(-1e-9), 255);
  EXPECT_EQ(residual_of(kNaN), 255);
}

TEST_P(Limits, AMotionThatDoesNotFitIsNotAvailableAsAWhole) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double value : {32.7671, -32.7671, kNaN, kInf, -kInf}) {
      PoseMessage message = valid_message();
      (*message.velocity_m_s)[axis] = value;
      const Reading got = read(message);
      for (const char* name : {"Velocity.VX", "Velocity.VY", "Velocity.VZ"}) {
        EXPECT_FALSE(got.available(name));
      }
      EXPECT_TRUE(got.available("Rates.WX"));
      message = valid_message();
      (*message.rates_rad_s)[axis] = value;
      const Reading other = read(message);
      for (const char* name : {"Rates.WX", "Rates.WY", "Rates.WZ"}) {
        EXPECT_FALSE(other.available(name));
      }
      EXPECT_TRUE(other.available("Velocity.VX"));
    }
  }
}

TEST_P(Limits, WhatIsNotKnownIsNotAvailable) {
  PoseMessage message = valid_message();
  message.covariance.reset();
  message.velocity_m_s.reset();
  message.rates_rad_s.reset();
  const Reading got = read(message);
  int silent = 0;
  for (const auto& [name, decoded] : got.signals()) {
    const bool quantity = name.find(".Sigma") != std::string::npos ||
                          name.find(".Corr") != std::string::npos ||
                          name.starts_with("Velocity.V") || name.starts_with("Rates.W");
    if (!quantity || name.starts_with("Dot")) continue;
    ++silent;
    EXPECT_EQ(decoded.text, "not available") << name;
  }
  EXPECT_EQ(silent, 27);
  EXPECT_EQ(got.raw(of("Quality", "Degraded")), message.degraded.bits());
  if (GetParam()) {
    EXPECT_EQ(got("FdPose.CovarianceFollows"), 0);
  }
}

TEST_P(Limits, ADotThatIsNotSeenOrDoesNotFitHasNoPosition) {
  for (const double x : {kLargest_m + 1e-6, kNaN, kInf, -kInf}) {
    PoseMessage message = valid_message();
    message.dots[15].visibility = Visibility::located;
    message.dots[15].position_m.z() = x;
    const Reading got = read(message);
    EXPECT_EQ(got("Dot16Detail.Visibility"), 2);
    for (const char* name :
         {"Dot16Position.X", "Dot16Position.Y", "Dot16Detail.Z", "Dot16Detail.Sigma"}) {
      EXPECT_FALSE(got.available(name)) << name;
    }
  }
  PoseMessage message = valid_message();
  message.dots[0].visibility = Visibility::not_seen;
  const Reading got = read(message);
  for (const char* name :
       {"Dot1Position.X", "Dot1Position.Y", "Dot1Detail.Z", "Dot1Detail.Sigma"}) {
    EXPECT_FALSE(got.available(name)) << name;
  }
}

TEST_P(Limits, ADotsSigmaIsRoundedUpAndNeverSaturates) {
  const auto sent = [](double sigma_m) {
    PoseMessage message = valid_message();
    message.dots[0].visibility = Visibility::located;
    message.dots[0].sigma_m = sigma_m;
    return read(message).raw("Dot1Detail.Sigma");
  };
  EXPECT_EQ(sent(1e-300), 1);
  EXPECT_EQ(sent(0.0005), 1);
  EXPECT_EQ(sent(0.00051), 2);
  EXPECT_EQ(sent(0.031), 62);
  for (const double none : {0.03101, kInf, kNaN, -1.0, 0.0}) EXPECT_EQ(sent(none), 63) << none;
}

TEST_P(Limits, MoreDotsThanThereCanBeAreSixteen) {
  PoseMessage message = valid_message();
  message.dots_used = 255;
  EXPECT_EQ(read(message)(of("Status", "DotsUsed")), 16);
}

TEST_P(Limits, TimeWrapsAfter48Bits) {
  PoseMessage message = valid_message();
  message.mid_exposure = Time(std::chrono::microseconds((std::int64_t{1} << 48) + 5));
  EXPECT_EQ(read(message)(of("Time", "MidExposure")), 5);
}

INSTANTIATE_TEST_SUITE_P(ClassicAndFd, Limits, testing::Values(false, true));

}  // namespace
}  // namespace dottrack::protocol::test
