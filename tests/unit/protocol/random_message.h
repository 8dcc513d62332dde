#pragma once
// Messages with every field random, within what the bus can carry.

#include <cmath>
#include <random>

#include "app/core/protocol/pose_message.h"

namespace dottrack::protocol::test {

inline Eigen::Quaterniond random_orientation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  return q.normalized();
}

inline PoseMessage random_message(std::mt19937_64& random) {
  std::uniform_real_distribution<double> metres(-200.0, 200.0);
  std::uniform_int_distribution<unsigned> bits;
  std::uniform_int_distribution<std::int64_t> nanoseconds(0, std::int64_t{1} << 57);
  PoseMessage message;
  message.state = static_cast<core::State>(bits(random) % 2);
  message.reason = static_cast<core::Reason>(bits(random) % 13);
  message.cameras_used = CameraSet(static_cast<std::uint16_t>(bits(random)));
  message.dots_used = static_cast<std::uint8_t>(bits(random) % 17);
  message.reset_count = static_cast<std::uint8_t>(bits(random));
  message.mid_exposure = Time(Duration(nanoseconds(random)));
  message.pose_valid = true;
  message.position_m = {metres(random), metres(random), metres(random)};
  message.orientation = random_orientation(random);
  return message;
}

}  // namespace dottrack::protocol::test
