#pragma once
// Between the trap and the two ways it listens to the heap.

#include <cstddef>

#if defined(DOTTRACK_SANITIZES_ADDRESS) || defined(DOTTRACK_SANITIZES_THREAD)
#define DOTTRACK_SANITIZER_HEAP 1
#else
#define DOTTRACK_SANITIZER_HEAP 0
#endif

namespace dottrack::rtos::trap {

// What a hook calls on every heap call, armed or not. Neither allocates.
void note_allocation(std::size_t bytes) noexcept;
void note_free() noexcept;

// Starts listening; may be called any number of times. False when it cannot.
bool install_hooks() noexcept;

}  // namespace dottrack::rtos::trap
