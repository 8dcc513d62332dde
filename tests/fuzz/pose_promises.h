#pragma once
// What every pose that the receiver hands out fulfils, whatever was on the bus.

#include "app/core/protocol/receiver/dottrack_receiver.h"

namespace dottrack::fuzz {

void check_content(const dottrack_pose& pose);

}  // namespace dottrack::fuzz
