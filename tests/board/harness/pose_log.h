#pragma once
// The pose messages that the listening CAN controller received.

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "app/core/protocol/pose_decoder.h"
#include "tests/board/harness/line_log.h"

namespace dottrack::board {

struct ReceivedPose {
  protocol::PoseMessage message;
  Time received{};  // on this machine's clock
  unsigned boot = 0;
};

// From any thread. Fed with the lines of candump.
class PoseLog {
 public:
  void take(const LoggedLine& line);
  void start_boot();

  std::size_t size() const;
  std::vector<ReceivedPose> from(std::size_t first) const;
  std::uint64_t incomplete_groups() const;

  // The index of the `count`-th message from `first` on that fits, once it is there; nothing when
  // it is not within `patience`.
  using Fits = std::function<bool(const ReceivedPose&)>;
  std::optional<std::size_t> wait_for(const Fits& fits, std::size_t count, std::size_t first,
                                      Duration patience) const;

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  protocol::PoseDecoder decoder_;
  std::vector<ReceivedPose> poses_;
  std::uint64_t earlier_incomplete_groups_ = 0;
  unsigned boot_ = 0;
};

// A pose of the vehicle, not only a sign of life.
inline bool is_pose(const ReceivedPose& pose) {
  return pose.message.pose_valid && pose.message.state == core::State::tracking;
}

}  // namespace dottrack::board
