#pragma once
// From CAN frames back to pose messages.

#include <array>
#include <cstdint>
#include <optional>

#include "app/core/protocol/pose_message.h"

namespace dottrack::protocol {

// Collects the frames of a group, which the group counter binds together. A group that another one
// overtakes before it is complete is dropped and counted.
class PoseDecoder {
 public:
  explicit PoseDecoder(std::uint32_t base_id = kDefaultBaseId) : base_id_(base_id) {}

  // Takes one frame; gives the message that it completes, if it does. Frames of other identifiers
  // are not for us and change nothing.
  std::optional<PoseMessage> push(std::uint32_t id, const Payload& data);

  std::uint64_t incomplete_groups() const { return incomplete_groups_; }
  std::uint64_t foreign_versions() const { return foreign_versions_; }  // complete, but not ours

 private:
  std::optional<PoseMessage> finish();

  std::uint32_t base_id_;
  std::array<std::uint64_t, kFramesPerPose> words_{};
  unsigned received_ = 0;  // one bit a frame of the group
  std::uint64_t counter_ = 0;
  std::uint64_t incomplete_groups_ = 0;
  std::uint64_t foreign_versions_ = 0;
};

}  // namespace dottrack::protocol
