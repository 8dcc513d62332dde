#include "rtos_shim/allocation_trap/allocation_trap.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <new>

#include "rtos_shim/allocation_trap/hooks.h"

namespace dottrack::rtos {
namespace {

struct ThreadState {
  HeapCalls calls;
  bool armed = false;
  AllocationTrap::Mode mode = AllocationTrap::Mode::count;
};

constinit thread_local ThreadState state;

// The heap is what is being watched, so nothing here may use it.
void stop_if_strict(const char* call, std::size_t bytes) noexcept {
  if (state.mode != AllocationTrap::Mode::strict) return;
  state.armed = false;
  char line[96];
  const int length = std::snprintf(line, sizeof line,
                                   "allocation trap: %s (%zu bytes) in a stretch of code that must "
                                   "leave the heap alone\n",
                                   call, bytes);
  if (length > 0) {
    const auto size = static_cast<std::size_t>(length);
    [[maybe_unused]] const auto written =
        ::write(STDERR_FILENO, line, size < sizeof line ? size : sizeof line - 1);
  }
  std::abort();
}

// Keeps the compiler from leaving out a pair of calls whose result nobody uses.
void* keep(void* block) {
  asm volatile("" : "+r"(block) : : "memory");
  return block;
}

}  // namespace

namespace trap {

void note_allocation(std::size_t bytes) noexcept {
  if (!state.armed) return;
  ++state.calls.allocations;
  stop_if_strict("an allocation", bytes);
}

void note_free() noexcept {
  if (!state.armed) return;
  ++state.calls.frees;
  stop_if_strict("a free", 0);
}

}  // namespace trap

AllocationTrap::Scope::Scope(Mode mode)
    : before_(state.calls), was_armed_(state.armed), mode_before_(state.mode) {
  trap::install_hooks();
  state.mode = mode;
  state.armed = true;
}

AllocationTrap::Scope::~Scope() {
  state.armed = was_armed_;
  state.mode = mode_before_;
}

HeapCalls AllocationTrap::Scope::calls() const {
  return {state.calls.allocations - before_.allocations, state.calls.frees - before_.frees};
}

bool AllocationTrap::is_complete() {
  if (!trap::install_hooks()) return false;
  const Scope armed;
  // NOLINTBEGIN(clang-analyzer-*): an analyzer does not see through keep()
  std::free(keep(std::malloc(1)));
  void* aligned = nullptr;
  if (::posix_memalign(&aligned, 64, 64) == 0) std::free(keep(aligned));
  ::operator delete(keep(::operator new(1)));
  // NOLINTEND(clang-analyzer-*)
  const HeapCalls seen = armed.calls();
  return seen.allocations == 3 && seen.frees == 3;
}

}  // namespace dottrack::rtos
