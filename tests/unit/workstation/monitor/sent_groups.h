#pragma once
// What a unit sends, group by group, at a steady rate.

#include <cmath>
#include <cstdint>
#include <vector>

#include "app/core/protocol/pose_encoder.h"
#include "app/workstation/monitor/frame_source.h"

namespace dottrack::monitor::test {

inline constexpr Duration kPeriod = std::chrono::milliseconds(33);
inline constexpr Duration kStart = std::chrono::seconds(1700000000);
inline constexpr Duration kAge = std::chrono::milliseconds(12);

// The n-th pose: another one each time, with everything that a message can have.
inline protocol::PoseMessage message_of(unsigned n) {
  protocol::PoseMessage message;
  message.state = core::State::tracking;
  message.reason = core::Reason::none;
  message.cameras_used = CameraSet(0b1011);
  message.dots_used = 5;
  message.reset_count = 7;
  message.degraded.insert(protocol::Degraded::few_cameras);
  message.mid_exposure = Time(std::chrono::seconds(40) + n * kPeriod);
  message.age = kAge;
  message.pose_valid = true;
  message.position_m = {1.0 + 0.01 * n, -2.5, 0.25};
  const double half_yaw = 0.02 * n;
  message.orientation = Eigen::Quaterniond(std::cos(half_yaw), 0.0, 0.0, std::sin(half_yaw));
  message.residual_m = 0.001;
  message.false_lock_probability = 1e-6;
  message.covariance = Eigen::Matrix<double, 6, 6>(Eigen::Matrix<double, 6, 6>::Identity() * 1e-6);
  message.velocity_m_s = Eigen::Vector3d(0.3, 0.0, -0.1);
  message.rates_rad_s = Eigen::Vector3d(0.0, 0.0, 0.5);
  message.dots_known = 2;
  message.dots[0].visibility = protocol::Visibility::located;
  message.dots[0].position_m = {1.5, -2.5, 0.5};
  message.dots[0].sigma_m = 0.001;
  message.cameras[0] = protocol::CameraHealth::used;
  message.cameras[1] = protocol::CameraHealth::no_frame;
  return message;
}

inline Duration arrival_of(unsigned n) {
  return kStart + n * kPeriod;
}

inline std::vector<Arrival> frames_of(unsigned n, const protocol::PoseMessage& message,
                                      const protocol::Addressing& addressing = {}) {
  protocol::GroupFrames frames;
  const protocol::GroupParts all{.covariance = true, .motion = true, .cameras = true, .dots = true};
  protocol::encode_group(message, all, addressing, static_cast<std::uint8_t>(n), frames);
  std::vector<Arrival> arrivals;
  for (const hal::CanFrame& frame : frames) arrivals.push_back({arrival_of(n), frame});
  return arrivals;
}

inline std::vector<Arrival> frames_of(unsigned n, const protocol::Addressing& addressing = {}) {
  return frames_of(n, message_of(n), addressing);
}

inline std::vector<Arrival> identity(unsigned n, const protocol::Addressing& addressing = {}) {
  const protocol::IdentityMessage message{.major = 1,
                                          .minor = 2,
                                          .patch = 3,
                                          .group_period = kPeriod,
                                          .config_hash = 0x1A2B3C4D,
                                          .target = 2,
                                          .cameras = 8};
  std::vector<Arrival> arrivals;
  for (const auto& frame :
       protocol::encode_identity(message, addressing, static_cast<std::uint8_t>(n))) {
    arrivals.push_back({arrival_of(n), frame});
  }
  return arrivals;
}

inline void append(std::vector<Arrival>& to, const std::vector<Arrival>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

inline std::vector<Arrival> groups(unsigned count, const protocol::Addressing& addressing = {}) {
  std::vector<Arrival> arrivals;
  for (unsigned n = 0; n < count; ++n) append(arrivals, frames_of(n, addressing));
  return arrivals;
}

}  // namespace dottrack::monitor::test
