#include "rtos_shim/posix_rt/posix_memory_lock.h"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <cerrno>

#include "rtos_shim/posix_rt/stack.h"
#include "rtos_shim/posix_rt/system_error.h"

namespace dottrack::rtos {
namespace {

std::string in_kib(std::size_t bytes) {
  return std::to_string(bytes / 1024) + " KiB";
}

// A second arena would reserve, and so lock, 64 MiB of addresses for each thread that allocates.
void keep_the_heap() {
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_ARENA_MAX, 1);
}

tl::unexpected<Error> refusal(int error_number) {
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  const std::string what = "memory: cannot be locked: " + reason_of(error_number);
  if (limit.rlim_cur == RLIM_INFINITY) return fail(what + "; expected enough RAM for all of it");
  return fail(what + "; RLIMIT_MEMLOCK is " + in_kib(limit.rlim_cur) +
              "; expected unlimited or CAP_IPC_LOCK");
}

}  // namespace

Result<void> PosixMemoryLock::do_lock_all(std::size_t stack_bytes) {
  if (const std::size_t left = stack_left_bytes(); stack_bytes > left) {
    return fail("memory: no " + in_kib(stack_bytes) + " of stack to touch; expected at most " +
                in_kib(left) + ", or a larger RLIMIT_STACK");
  }
  keep_the_heap();
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) return refusal(errno);
  touch_stack(stack_bytes);
  return {};
}

}  // namespace dottrack::rtos
