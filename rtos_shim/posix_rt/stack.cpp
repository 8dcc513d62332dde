#include "rtos_shim/posix_rt/stack.h"

#include <pthread.h>
#include <unistd.h>

#include <cstdint>

namespace dottrack::rtos {
namespace {

std::uintptr_t stack_end() {
  pthread_attr_t attributes;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return UINTPTR_MAX;
  void* lowest = nullptr;
  std::size_t size = 0;
  pthread_attr_getstack(&attributes, &lowest, &size);
  pthread_attr_destroy(&attributes);
  return reinterpret_cast<std::uintptr_t>(lowest);
}

}  // namespace

std::size_t stack_left_bytes() {
  const auto here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  const std::uintptr_t end = stack_end();
  return here > end ? here - end : 0;
}

// Page by page downwards, the way a stack grows. The page of this very frame is in memory already,
// and the foot of each page below it is out of reach of what this frame holds. To a sanitizer such
// writes are astray.
[[gnu::noinline, gnu::no_sanitize_address, gnu::no_sanitize_thread]] void touch_stack(
    std::size_t depth_bytes) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  const std::uintptr_t end = here - depth_bytes;
  for (std::uintptr_t foot = here - here % page; foot > end;) {
    foot -= page;
    *reinterpret_cast<volatile char*>(foot) = 0;
  }
}

}  // namespace dottrack::rtos
