// Under the address or thread sanitizer: the sanitizer tells what happens on its heap.

#include "rtos_shim/allocation_trap/hooks.h"

#if DOTTRACK_SANITIZER_HEAP

// NOLINTNEXTLINE(bugprone-reserved-identifier): the sanitizers' own name
extern "C" int __sanitizer_install_malloc_and_free_hooks(
    void (*on_malloc)(const volatile void* block, std::size_t size),
    void (*on_free)(const volatile void* block));

namespace dottrack::rtos::trap {
namespace {

void on_malloc(const volatile void* /*block*/, std::size_t size) {
  note_allocation(size);
}

void on_free(const volatile void* block) {
  if (block != nullptr) note_free();
}

}  // namespace

bool install_hooks() noexcept {
  static const bool installed = __sanitizer_install_malloc_and_free_hooks(&on_malloc, &on_free) > 0;
  return installed;
}

}  // namespace dottrack::rtos::trap

#endif
