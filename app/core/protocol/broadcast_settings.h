#pragma once
// What a unit sends, how often and under which identifiers.

#include <cstdint>

#include "app/core/protocol/addressing.h"
#include "app/core/protocol/bus_load.h"
#include "app/core/protocol/degraded.h"
#include "app/core/protocol/pose_message.h"

namespace dottrack::protocol {

// Which pose goes out as the pose. The first has gaps where the target is not seen; the others go
// on for as long as the filter may coast, and say so.
enum class PoseChoice : std::uint8_t { measured, filtered, predicted };

struct BroadcastSettings {
  Addressing addressing;
  Rates rates;
  PoseChoice pose = PoseChoice::measured;
  IdentityMessage identity;
  DegradedSet standing;      // reasons that hold as long as the program runs
  bool commands = false;     // listen to them
  std::uint8_t targets = 1;  // of the rig, for set_target
  std::uint8_t first_sequence = 0;
};

}  // namespace dottrack::protocol
