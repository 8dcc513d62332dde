#pragma once
// Memory that cannot be paged out, so that no tick waits for a disk.

#include <cstddef>

#include "hal/base/result.h"

namespace dottrack::rtos {

// Contract: after lock_all() every page that the process has, and every page it gets later, stays
// in memory; the calling thread's stack is touched to a depth of stack_bytes. Start-up only.
class MemoryLock {
 public:
  MemoryLock() = default;
  MemoryLock(const MemoryLock&) = delete;
  MemoryLock& operator=(const MemoryLock&) = delete;
  virtual ~MemoryLock() = default;

  Result<void> lock_all(std::size_t stack_bytes) { return do_lock_all(stack_bytes); }

 private:
  virtual Result<void> do_lock_all(std::size_t stack_bytes) = 0;
};

}  // namespace dottrack::rtos
