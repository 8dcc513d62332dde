#pragma once
// When a group of messages goes out, and what belongs to it.

#include <cstdint>
#include <optional>

#include "app/core/protocol/bus_load.h"
#include "app/core/protocol/pose_encoder.h"

namespace dottrack::cycle {

// What a receiver has to know at once, not when the next group is due.
struct Announcement {
  core::State state = core::State::acquiring;
  bool pose_valid = false;
  std::uint8_t reset_count = 0;
  protocol::DegradedSet degraded;

  bool operator==(const Announcement&) const = default;
};

Announcement announcement_of(const protocol::PoseMessage& message);

class BroadcastPlan {
 public:
  explicit BroadcastPlan(const protocol::Rates& rates) : rates_(rates) {}

  // Once a tick. A group is due by its rate, when there is something to announce, and when the one
  // before did not go out whole.
  std::optional<protocol::GroupParts> next(const Announcement& announcement);

  // Of the group that `next` asked for.
  void sent_whole(bool whole) { owed_ = !whole; }

  // Whether the identity is due with this group. Asked once a group, after `next`.
  bool identity_due() const { return falls_due(rates_.identity_every); }
  // Whether the light of the next camera is. Not after a group that was cut short.
  bool light_due() const { return !owed_ && falls_due(rates_.light_every); }

 private:
  bool falls_due(unsigned every) const { return every != 0 && (groups_ - 1) % every == 0; }

  protocol::Rates rates_;
  std::uint64_t groups_ = 0;  // begun so far
  unsigned ticks_since_group_ = 0;
  bool owed_ = true;
  Announcement announced_;
};

}  // namespace dottrack::cycle
