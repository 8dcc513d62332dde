#pragma once
// What a stream of poses becomes in MAVLink, datagram by datagram: no socket, no clock, the same
// bytes for the same poses.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "app/workstation/mavlink/mavlink_frame.h"
#include "app/workstation/mavlink/mavlink_sender.h"
#include "app/workstation/mavlink/vision_messages.h"

namespace dottrack::workstation {

// Whether it is sent as a pose: it is valid, and how old it is is known.
bool can_be_handed_over(const dottrack_pose& pose);

class PoseSequence {
 public:
  explicit PoseSequence(const MavlinkOptions& options) : options_(options) {}

  // The frames of one group, valid until the next call: none, when it has no pose and no heartbeat
  // is due.
  std::span<const MavlinkFrame> frames_of(const dottrack_pose& pose);

 private:
  void append(const MavlinkMessage& message);
  bool heartbeat_due(std::uint64_t now_us);
  void follow_resets(const dottrack_pose& pose);

  MavlinkOptions options_;
  std::uint8_t sequence_ = 0;
  std::uint8_t reset_counter_ = 0;  // moves whenever the unit's does, and when the unit restarts
  std::optional<std::uint8_t> unit_resets_;
  std::optional<std::uint64_t> heartbeat_us_;
  std::array<MavlinkFrame, 3> frames_{};
  std::size_t count_ = 0;
};

}  // namespace dottrack::workstation
