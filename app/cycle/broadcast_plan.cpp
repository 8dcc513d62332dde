#include "app/cycle/broadcast_plan.h"

namespace dottrack::cycle {

Announcement announcement_of(const protocol::PoseMessage& message) {
  return {message.state, message.pose_valid, message.reset_count, message.degraded};
}

std::optional<protocol::GroupParts> BroadcastPlan::next(const Announcement& announcement) {
  ++ticks_since_group_;
  const bool by_rate = ticks_since_group_ >= rates_.pose_every;
  if (!by_rate && !owed_ && announcement == announced_) return std::nullopt;
  announced_ = announcement;
  ticks_since_group_ = 0;
  ++groups_;
  return protocol::GroupParts{.covariance = falls_due(rates_.covariance_every),
                              .motion = falls_due(rates_.motion_every),
                              .cameras = falls_due(rates_.cameras_every),
                              .dots = falls_due(rates_.dots_every)};
}

}  // namespace dottrack::cycle
