#pragma once
// The calling thread's own stack: how much is left of it, and having it in memory before it is
// used.

#include <cstddef>

namespace dottrack::rtos {

// Bytes between here and the end of the calling thread's stack. Start-up only: it may read files.
std::size_t stack_left_bytes();

// Writes to every page down to depth_bytes below here, so that none has to be fetched when a call
// goes that deep. Precondition: depth_bytes <= stack_left_bytes().
void touch_stack(std::size_t depth_bytes);

}  // namespace dottrack::rtos
