#pragma once
// What a rig sends on CAN, and as what it introduces itself.

#include <cstddef>

#include "app/config/rig_file.h"
#include "app/core/protocol/broadcast_settings.h"

namespace dottrack::config {

// Of the target that is in force. Start-up only.
protocol::BroadcastSettings broadcast_settings(const RigConfig& config);

// Dots of the largest target.
std::size_t most_dots(const RigConfig& config);

}  // namespace dottrack::config
