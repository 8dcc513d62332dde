#pragma once
// Messages with every field random, within what the bus can carry.

#include <cmath>
#include <random>

#include "app/core/protocol/pose_encoder.h"
#include "tests/unit/protocol/random_covariance.h"

namespace dottrack::protocol::test {

inline constexpr GroupParts kAllParts{
    .covariance = true, .motion = true, .cameras = true, .dots = true};

inline Eigen::Quaterniond random_orientation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  return q.normalized();
}

inline Eigen::Vector3d random_vector(std::mt19937_64& random, double largest) {
  std::uniform_real_distribution<double> part(-largest, largest);
  const double x = part(random);
  const double y = part(random);
  return {x, y, part(random)};
}

inline DotReport random_dot(std::mt19937_64& random) {
  DotReport dot;
  dot.visibility = static_cast<Visibility>(random() % 3);
  dot.position_m = random_vector(random, 200.0);
  dot.sigma_m = std::uniform_real_distribution<double>(1e-6, 0.031)(random);
  dot.cameras = CameraSet(static_cast<std::uint16_t>(random()));
  return dot;
}

inline PoseMessage random_message(std::mt19937_64& random) {
  PoseMessage message;
  message.state = static_cast<core::State>(random() % 2);
  message.reason = static_cast<core::Reason>(random() % 15);
  message.cameras_used = CameraSet(static_cast<std::uint16_t>(random()));
  message.dots_used = static_cast<std::uint8_t>(random() % 17);
  message.kind = static_cast<PoseKind>(random() % 4);
  message.reset_count = static_cast<std::uint8_t>(random());
  message.degraded = DegradedSet(static_cast<std::uint16_t>(random() % (1U << kDegradedReasons)));
  message.mid_exposure = Time(Duration(static_cast<std::int64_t>(random() >> 7U)));
  message.age = Duration(static_cast<std::int64_t>(random() % 6'000'000'000U));
  message.pose_valid = true;
  message.position_m = random_vector(random, 200.0);
  message.orientation = random_orientation(random);
  message.residual_m = std::uniform_real_distribution<double>(0.0, 0.06)(random);
  message.false_lock_probability = std::ldexp(1.0, -static_cast<int>(random() % 200));
  message.covariance = random_covariance(random);
  message.velocity_m_s = random_vector(random, 30.0);
  message.rates_rad_s = random_vector(random, 16.0);
  message.dots_known = static_cast<std::uint8_t>(random() % 17);
  for (DotReport& dot : message.dots) dot = random_dot(random);
  for (CameraHealth& camera : message.cameras) camera = static_cast<CameraHealth>(random() % 8);
  return message;
}

inline Addressing classic() {
  return {};
}
inline Addressing fd() {
  return {.base_id = kDefaultBaseId, .extended = false, .fd = true};
}

inline GroupFrames encoded(const PoseMessage& message, const Addressing& addressing,
                           const GroupParts& parts = kAllParts, std::uint8_t sequence = 0) {
  GroupFrames frames;
  encode_group(message, parts, addressing, sequence, frames);
  return frames;
}

}  // namespace dottrack::protocol::test
