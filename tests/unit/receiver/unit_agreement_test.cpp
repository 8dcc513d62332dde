// What the unit's encoder sends is what the vehicle's receiver says, within the rounding promised.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "app/core/protocol/degraded.h"
#include "app/core/protocol/light_message.h"
#include "app/core/reason.h"
#include "tests/support/bus_listener.h"
#include "tests/unit/protocol/random_light.h"
#include "tests/unit/protocol/random_message.h"

namespace dottrack::receiver_test {
namespace {

namespace protocol = dottrack::protocol;
using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

constexpr unsigned kMessages = 3000;

protocol::PoseMessage young_message(std::mt19937_64& random) {
  protocol::PoseMessage message = protocol::test::random_message(random);
  message.age = Duration(static_cast<std::int64_t>(random() % 250'000'000U));
  return message;
}

dottrack_pose received(const protocol::PoseMessage& message,
                       const protocol::Addressing& addressing) {
  test::BusListener listener(addressing);
  dottrack_verdict verdict = DOTTRACK_FOREIGN;
  for (const hal::CanFrame& frame : protocol::test::encoded(message, addressing)) {
    verdict = listener.hear(frame);
  }
  EXPECT_EQ(verdict, DOTTRACK_FRESH);
  return listener.poses().empty() ? dottrack_pose{} : listener.poses().back();
}

class ReceiverAgreesWithTheUnit : public testing::TestWithParam<bool> {
 protected:
  protocol::Addressing addressing() const {
    return {.base_id = 0x140, .extended = false, .fd = GetParam()};
  }
};

TEST_P(ReceiverAgreesWithTheUnit, AboutStatusAndPose) {
  std::mt19937_64 random(1);
  for (unsigned i = 0; i < kMessages; ++i) {
    const protocol::PoseMessage sent = young_message(random);
    const dottrack_pose pose = received(sent, addressing());
    ASSERT_EQ(pose.state, static_cast<std::uint8_t>(sent.state));
    ASSERT_EQ(pose.reason, static_cast<std::uint8_t>(sent.reason));
    ASSERT_EQ(pose.dots_used, sent.dots_used);
    ASSERT_EQ(pose.kind, static_cast<std::uint8_t>(sent.kind));
    ASSERT_EQ(pose.reset_count, sent.reset_count);
    ASSERT_TRUE(pose.valid);
    ASSERT_GE(pose.age_us * 1000.0, static_cast<double>(sent.age.count()));
    ASSERT_LT(pose.age_us * 1000.0, static_cast<double>(sent.age.count()) + 100'000.0);
    for (Eigen::Index k = 0; k < 3; ++k) {
      ASSERT_NEAR(pose.position_m[k], sent.position_m[k], 0.5001e-4);
    }
    const auto* q = pose.orientation_wxyz;
    const Eigen::Quaterniond orientation(q[0], q[1], q[2], q[3]);
    ASSERT_LT(orientation.angularDistance(sent.orientation) * 180.0 / M_PI, 0.005);
    ASSERT_GE(pose.residual_m, sent.residual_m);
    ASSERT_GE(pose.false_lock_probability, sent.false_lock_probability);
  }
}

TEST_P(ReceiverAgreesWithTheUnit, ThatTheCovarianceIsNeverUnderstated) {
  std::mt19937_64 random(2);
  unsigned compared = 0;
  for (unsigned i = 0; i < kMessages; ++i) {
    const protocol::PoseMessage sent = young_message(random);
    const dottrack_pose pose = received(sent, addressing());
    if (!pose.has_covariance) continue;
    const Matrix6 excess = Eigen::Map<const Matrix6>(pose.covariance) - *sent.covariance;
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(excess, Eigen::EigenvaluesOnly);
    ASSERT_GE(solver.eigenvalues().minCoeff(), -1e-15);
    ++compared;
  }
  EXPECT_GE(compared, kMessages / 2);
}

TEST_P(ReceiverAgreesWithTheUnit, AboutMotionCamerasAndDots) {
  std::mt19937_64 random(3);
  std::size_t dots = 0;
  for (unsigned i = 0; i < kMessages; ++i) {
    const protocol::PoseMessage sent = young_message(random);
    const dottrack_pose pose = received(sent, addressing());
    ASSERT_TRUE(pose.has_velocity && pose.has_rates && pose.has_cameras);
    for (Eigen::Index k = 0; k < 3; ++k) {
      ASSERT_NEAR(pose.velocity_m_s[k], (*sent.velocity_m_s)[k], 0.501e-3);
      ASSERT_NEAR(pose.rates_rad_s[k], (*sent.rates_rad_s)[k], 0.251e-3);
    }
    for (std::size_t k = 0; k < 16; ++k) {
      ASSERT_EQ(pose.camera_health[k], static_cast<std::uint8_t>(sent.cameras[k]));
    }
    ASSERT_EQ(pose.dots, sent.dots_known);
    for (std::size_t k = 0; k < pose.dots; ++k) {
      const auto seen = static_cast<std::uint8_t>(sent.dots[k].visibility);
      ASSERT_EQ(pose.dot[k].visibility, seen);
      ASSERT_EQ(pose.dot[k].has_position, seen != DOTTRACK_NOT_SEEN);
      ++dots;
    }
  }
  EXPECT_GE(dots, 5U * kMessages);
}

TEST_P(ReceiverAgreesWithTheUnit, ThatThereIsNoPose) {
  std::mt19937_64 random(4);
  protocol::PoseMessage lost = young_message(random);
  lost.pose_valid = false;
  EXPECT_FALSE(received(lost, addressing()).valid);
  protocol::PoseMessage far = young_message(random);
  far.position_m.x() = 900.0;
  const dottrack_pose pose = received(far, addressing());
  EXPECT_FALSE(pose.valid);
  EXPECT_TRUE(pose.out_of_range);
}

INSTANTIATE_TEST_SUITE_P(Buses, ReceiverAgreesWithTheUnit, testing::Bool(),
                         [](const auto& bus) { return bus.param ? "Fd" : "Classic"; });

TEST(ReceiverAgreesWithTheUnit, AboutLight) {
  std::mt19937_64 random(5);
  const protocol::Addressing addressing{.base_id = 0x140, .extended = true};
  unsigned set = 0;
  for (unsigned i = 0; i < kMessages; ++i) {
    const auto camera = static_cast<std::uint8_t>(random() % 16);
    const exposure::CameraLight sent = protocol::test::random_light(random);
    test::BusListener listener(addressing);
    ASSERT_EQ(listener.hear(protocol::encode_light(camera, sent, addressing, 9)), DOTTRACK_WAITING);
    const dottrack_light& light = listener.light(camera);
    ASSERT_TRUE(light.known);
    ASSERT_EQ(light.state, static_cast<std::uint8_t>(sent.state));
    ASSERT_EQ(light.iris, static_cast<std::uint8_t>(sent.iris));
    if (sent.state == exposure::LightState::off) {
      ASSERT_TRUE(light.exposure_s < 0.0 && light.gain < 0.0 && light.opening < 0.0);
      continue;
    }
    ASSERT_NEAR(light.exposure_s, to_seconds(sent.setting.exposure), 0.5001e-6);
    ASSERT_NEAR(light.gain, sent.setting.gain, 0.005001);
    ASSERT_NEAR(light.opening, sent.opening, 0.005001);
    ++set;
  }
  EXPECT_GE(set, kMessages / 2);
}

TEST(ReceiverWords, AreTheUnits) {
  for (unsigned i = 0; i < 15; ++i) {
    const auto number = static_cast<std::uint8_t>(i);
    EXPECT_EQ(dottrack_reason_text(number), core::to_string(static_cast<core::Reason>(number)));
  }
  for (unsigned bit = 0; bit < protocol::kDegradedReasons; ++bit) {
    const auto reason = static_cast<protocol::Degraded>(bit);
    EXPECT_EQ(dottrack_degraded_text(bit), protocol::to_string(reason));
  }
  for (std::uint8_t i = 0; i < 2; ++i) {
    EXPECT_EQ(dottrack_state_text(i), core::to_string(static_cast<core::State>(i)));
  }
}

}  // namespace
}  // namespace dottrack::receiver_test
