#pragma once
// Settings of the calling thread, put in force and then looked at.

#include "hal/base/result.h"
#include "rtos_shim/thread.h"

namespace dottrack::rtos {

// Gives the calling thread its name, processor and priority, and touches its stack whole. The stack
// itself is what it is: settings.stack_bytes does not count here. Without a processor to run on it
// gets the ones that the program's first thread may run on; without a priority, ordinary
// scheduling. The first setting that cannot be had is the error; those before it stay in force.
Result<void> apply_to_this_thread(const ThreadSettings& settings);

}  // namespace dottrack::rtos
