// What was read from the bus and is sent again is the same raw number: no rounding wanders.

#include <gtest/gtest.h>

#include "tests/unit/protocol/dbc_reading.h"
#include "tests/unit/protocol/random_message.h"

namespace dottrack::protocol::test {
namespace {

PoseMessage valid_message() {
  PoseMessage message;
  message.pose_valid = true;
  message.velocity_m_s = Eigen::Vector3d::Zero();
  message.rates_rad_s = Eigen::Vector3d::Zero();
  message.dots_known = 1;
  message.dots[0].visibility = Visibility::located;
  return message;
}

// The raw number that the encoder makes of the value of each raw number in turn.
template <class Set>
int wanderers(const std::string& name, std::int64_t first, std::int64_t last, std::int64_t step,
              const Addressing& addressing, Set set) {
  const double factor =
      layout_of(name.substr(0, name.find('.'))).signal(name.substr(name.find('.') + 1))->factor;
  int wrong = 0;
  PoseMessage message = valid_message();
  const GroupParts parts{.covariance = false, .motion = true, .cameras = false, .dots = true};
  const std::uint32_t id = layout_of(name.substr(0, name.find('.'))).id;
  for (std::int64_t raw = first; raw <= last; raw += step) {
    set(message, static_cast<double>(raw) * factor, raw);
    Reading reading;
    for (const hal::CanFrame& frame : encoded(message, addressing, parts)) {
      if (frame.id == id) reading.add(frame);
    }
    wrong += reading.raw(name) == raw ? 0 : 1;
  }
  return wrong;
}

TEST(FixedPoint, Position) {
  const auto set_x = [](PoseMessage& m, double value, std::int64_t) { m.position_m.x() = value; };
  const auto set_z = [](PoseMessage& m, double value, std::int64_t) { m.position_m.z() = value; };
  constexpr std::int64_t kEnd = 8388607;
  EXPECT_EQ(wanderers("Position.X", -kEnd, kEnd, 997, classic(), set_x), 0);
  EXPECT_EQ(wanderers("FdPose.Z", -kEnd, kEnd, 991, fd(), set_z), 0);
  EXPECT_EQ(wanderers("Position.X", kEnd - 100, kEnd, 1, classic(), set_x), 0);
}

TEST(FixedPoint, Motion) {
  const auto set_v = [](PoseMessage& m, double value, std::int64_t) {
    m.velocity_m_s->y() = value;
  };
  const auto set_w = [](PoseMessage& m, double value, std::int64_t) { m.rates_rad_s->z() = value; };
  EXPECT_EQ(wanderers("Velocity.VY", -32767, 32767, 1, classic(), set_v), 0);
  EXPECT_EQ(wanderers("Rates.WZ", -32767, 32767, 1, classic(), set_w), 0);
}

TEST(FixedPoint, Quality) {
  const auto set_residual = [](PoseMessage& m, double value, std::int64_t) {
    m.residual_m = value;
  };
  const auto set_age = [](PoseMessage& m, double, std::int64_t raw) {
    m.age = raw * std::chrono::microseconds(100);
  };
  const auto set_false_lock = [](PoseMessage& m, double, std::int64_t raw) {
    m.false_lock_probability = std::ldexp(1.0, -static_cast<int>(raw));
  };
  for (const bool is_fd : {false, true}) {
    const Addressing addressing = is_fd ? fd() : classic();
    const std::string quality = is_fd ? "FdPose" : "Quality";
    const std::string residual = is_fd ? "FdPose.Residual" : "Position2.Residual";
    EXPECT_EQ(wanderers(residual, 0, 254, 1, addressing, set_residual), 0);
    EXPECT_EQ(wanderers(quality + ".Age", 0, 65534, 1, addressing, set_age), 0);
    EXPECT_EQ(wanderers(quality + ".FalseLock", 0, 254, 1, addressing, set_false_lock), 0);
  }
}

TEST(FixedPoint, SigmaOfADot) {
  const auto set = [](PoseMessage& m, double value, std::int64_t) { m.dots[0].sigma_m = value; };
  EXPECT_EQ(wanderers("Dot1Detail.Sigma", 1, 62, 1, classic(), set), 0);
}

TEST(FixedPoint, QuaternionStaysWithinAStep) {
  // Read and made a unit one again, as a receiver does.
  std::mt19937_64 random(1);
  PoseMessage message = valid_message();
  const std::array<std::string, 4> names{"FdPose.QX", "FdPose.QY", "FdPose.QZ", "FdPose.QW"};
  for (int i = 0; i < 20000; ++i) {
    message.orientation = random_orientation(random);
    const Reading first(encoded(message, fd(), {}));
    for (int k = 0; k < 4; ++k) message.orientation.coeffs()[k] = first(names.at(std::size_t(k)));
    message.orientation.normalize();
    const Reading again(encoded(message, fd(), {}));
    for (const std::string& name : names) ASSERT_LE(std::abs(again.raw(name) - first.raw(name)), 1);
  }
}

}  // namespace
}  // namespace dottrack::protocol::test
