#pragma once
// All memory of the process kept in RAM, and a heap that keeps what it has.

#include "rtos_shim/memory_lock.h"

namespace dottrack::rtos {

// Holds for the process, not for this object: it is not undone. The heap then stays one piece that
// only grows: freed memory is not handed back, so that memory once used is never fetched anew. Lock
// before starting threads that allocate.
class PosixMemoryLock final : public MemoryLock {
 private:
  Result<void> do_lock_all(std::size_t stack_bytes) override;
};

}  // namespace dottrack::rtos
