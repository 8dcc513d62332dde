#pragma once
// Proof that a stretch of code leaves the heap alone. A program that links this target has its
// malloc, calloc, realloc, free and aligned relatives replaced by ones that count first and then do
// what they always did. Every form of operator new and delete ends in those.
//
// With the address or thread sanitizer, the sanitizer owns the heap; there the trap counts through
// the sanitizer's hooks instead, and a realloc counts as an allocation and a free. The thread
// sanitizer does not tell of memalign and its relatives: there is_complete() is false.

#include <cstdint>

namespace dottrack::rtos {

struct HeapCalls {
  std::uint64_t allocations = 0;  // malloc, calloc, realloc, aligned forms, new
  std::uint64_t frees = 0;        // free and delete, of anything but a null pointer

  std::uint64_t total() const { return allocations + frees; }
};

class AllocationTrap {
 public:
  enum class Mode : std::uint8_t {
    count,   // what happened is counted
    strict,  // the first heap call ends the program with a message: for finding the culprit
  };

  // Armed from construction to destruction, for the thread that made it and no other. Scopes nest;
  // the outer one sees what the inner one saw.
  class Scope {
   public:
    explicit Scope(Mode mode = Mode::count);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

    HeapCalls calls() const;  // since construction

   private:
    HeapCalls before_;
    bool was_armed_;
    Mode mode_before_;
  };

  // True when trial calls of malloc, posix_memalign and new are all seen: the trap is in place.
  static bool is_complete();
};

}  // namespace dottrack::rtos
