#include "app/config/broadcast.h"

#include <cmath>

namespace dottrack::config {
namespace {

protocol::IdentityMessage identity_of(const RigConfig& config) {
  const double group_s = config.unit.can.rates.pose_every / config.frame_rate_hz;
  return {.major = DOTTRACK_VERSION_MAJOR,
          .minor = DOTTRACK_VERSION_MINOR,
          .patch = DOTTRACK_VERSION_PATCH,
          .group_period = Duration(std::llround(1e9 * group_s)),
          .config_hash = config.config_hash,
          .target = static_cast<std::uint8_t>(config.target_index),
          .cameras = static_cast<std::uint8_t>(config.cameras.size())};
}

}  // namespace

protocol::BroadcastSettings broadcast_settings(const RigConfig& config) {
  protocol::BroadcastSettings settings;
  settings.addressing = config.unit.can.addressing;
  settings.rates = config.unit.can.rates;
  settings.identity = identity_of(config);
  settings.pose = config.unit.can.pose;
  settings.commands = config.unit.can.commands;
  settings.targets = static_cast<std::uint8_t>(config.targets.size());
  return settings;
}

std::size_t most_dots(const RigConfig& config) {
  return can_use(config).dots;
}

}  // namespace dottrack::config
