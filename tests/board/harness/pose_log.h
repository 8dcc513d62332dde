#pragma once
// The poses that the listening CAN controller received, as a vehicle's receiver has them.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "tests/board/harness/line_log.h"

namespace dottrack::board {

struct ReceivedPose {
  dottrack_pose message{};
  bool fresh = false;  // else stale
  Time received{};     // on this machine's clock
  unsigned boot = 0;
};

// From any thread. Fed with the lines of candump. One receiver for the whole run: that the unit was
// reset, it has to find out by itself.
class PoseLog {
 public:
  // The emulator keeps no real time: a pose counts as stale, and a group as given up, only after
  // far longer than on a real bus.
  static constexpr std::uint32_t kAgeLimit_us = 5'000'000;
  static constexpr std::uint32_t kGroupTimeout_us = 5'000'000;

  PoseLog();

  void take(const LoggedLine& line);
  void start_boot();

  std::size_t size() const;
  std::vector<ReceivedPose> from(std::size_t first) const;
  dottrack_counts counts() const;
  dottrack_unit unit() const;

  // The index of the `count`-th message from `first` on that fits, once it is there; nothing when
  // it is not within `patience`.
  using Fits = std::function<bool(const ReceivedPose&)>;
  std::optional<std::size_t> wait_for(const Fits& fits, std::size_t count, std::size_t first,
                                      Duration patience) const;

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  dottrack_receiver receiver_{};
  std::vector<ReceivedPose> poses_;
  unsigned boot_ = 0;
};

// A pose of the vehicle, not only a sign of life.
inline bool is_pose(const ReceivedPose& pose) {
  return pose.message.valid && pose.message.state == DOTTRACK_TRACKING;
}

inline bool rests_on(const ReceivedPose& pose, std::size_t camera) {
  return (pose.message.cameras_used >> camera & 1) != 0;
}

inline Time mid_exposure(const ReceivedPose& pose) {
  return Time(std::chrono::microseconds(pose.message.capture_us));
}

inline Eigen::Vector3d position_m(const ReceivedPose& pose) {
  return Eigen::Vector3d(pose.message.position_m);
}

inline Eigen::Quaterniond orientation(const ReceivedPose& pose) {
  const double* wxyz = pose.message.orientation_wxyz;
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

}  // namespace dottrack::board
