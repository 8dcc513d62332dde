// The C library's heap, behind functions of the same names that count first. A definition in the
// program wins over the library's, for the program and for every library it loads.

#include "rtos_shim/allocation_trap/hooks.h"

#if !DOTTRACK_SANITIZER_HEAP

#include <bit>
#include <cerrno>
#include <cstdlib>

#ifndef __GLIBC__
#error "the allocation trap forwards to glibc's own names; another C library needs other names"
#endif

namespace trap = dottrack::rtos::trap;

// NOLINTBEGIN(bugprone-reserved-identifier): glibc's second names for its heap
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void* __libc_valloc(std::size_t size);
void* __libc_pvalloc(std::size_t size);
void __libc_free(void* block);
}
// NOLINTEND(bugprone-reserved-identifier)

extern "C" {

void* malloc(std::size_t size) noexcept {
  trap::note_allocation(size);
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  trap::note_allocation(count * size);
  return __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) noexcept {
  trap::note_allocation(size);
  return __libc_realloc(block, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  trap::note_allocation(size);
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept {
  if (alignment % sizeof(void*) != 0 || !std::has_single_bit(alignment)) return EINVAL;
  void* const got = memalign(alignment, size);
  if (got == nullptr) return ENOMEM;
  *block = got;
  return 0;
}

void* valloc(std::size_t size) noexcept {
  trap::note_allocation(size);
  return __libc_valloc(size);
}

void* pvalloc(std::size_t size) noexcept {
  trap::note_allocation(size);
  return __libc_pvalloc(size);
}

void free(void* block) noexcept {
  if (block != nullptr) trap::note_free();
  __libc_free(block);
}

}  // extern "C"

bool dottrack::rtos::trap::install_hooks() noexcept {
  return true;
}

#endif
