// The trap proves that the loop leaves the heap alone; these tests prove that the trap sees.

#include "rtos_shim/allocation_trap/allocation_trap.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

namespace dottrack::rtos {
namespace {

// Keeps the compiler from leaving out a pair of heap calls.
template <class T>
T* keep(T* block) {
  asm volatile("" : "+r"(block) : : "memory");
  return block;
}

struct alignas(128) OverAligned {
  char bytes[128];
};

#ifdef DOTTRACK_SANITIZES_THREAD
constexpr bool kAlignedFormsAreSeen = false;  // the thread sanitizer does not tell of them
#else
constexpr bool kAlignedFormsAreSeen = true;
#endif

struct Kind {
  std::string name;
  std::function<void*()> allocate;
  std::function<void(void*)> release;
  bool seen = true;
};

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

void* by_posix_memalign() {
  void* block = nullptr;
  return ::posix_memalign(&block, 64, 100) == 0 ? block : nullptr;
}

void* by_strdup() {
  return ::strdup("a copy that the C library makes by itself");
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"malloc", [] { return std::malloc(10); }, [](void* b) { std::free(b); }},
      {"calloc", [] { return std::calloc(3, 10); }, [](void* b) { std::free(b); }},
      {"realloc", [] { return std::realloc(nullptr, 10); }, [](void* b) { std::free(b); }},
      {"aligned_alloc", [] { return std::aligned_alloc(64, 128); }, [](void* b) { std::free(b); },
       kAlignedFormsAreSeen},
      {"posix_memalign", by_posix_memalign, [](void* b) { std::free(b); }, kAlignedFormsAreSeen},
      {"memalign", [] { return ::memalign(64, 100); }, [](void* b) { std::free(b); },
       kAlignedFormsAreSeen},
      {"strdup", by_strdup, [](void* b) { std::free(b); }},
      {"new", [] { return ::operator new(10); }, [](void* b) { ::operator delete(b); }},
      {"new_object", [] { return static_cast<void*>(new int(1)); },
       [](void* b) { delete static_cast<int*>(b); }},  // sized delete
      {"new_array", [] { return ::operator new[](10); }, [](void* b) { ::operator delete[](b); }},
      {"new_nothrow", [] { return ::operator new(10, std::nothrow); },
       [](void* b) { ::operator delete(b, std::nothrow); }},
      {"new_array_nothrow", [] { return ::operator new[](10, std::nothrow); },
       [](void* b) { ::operator delete[](b, std::nothrow); }},
      {"new_aligned", [] { return static_cast<void*>(new OverAligned); },
       [](void* b) { delete static_cast<OverAligned*>(b); }},
      {"new_array_aligned", [] { return static_cast<void*>(new OverAligned[2]); },
       [](void* b) { delete[] static_cast<OverAligned*>(b); }},
  };
  return all;
}

class EveryKind : public testing::TestWithParam<Kind> {};

TEST_P(EveryKind, IsSeenOnceWhenItTakesAndOnceWhenItGivesBack) {
  const Kind& kind = GetParam();
  HeapCalls taken;
  HeapCalls given_back;
  void* block = nullptr;
  {
    const AllocationTrap::Scope armed;
    block = keep(kind.allocate());
    taken = armed.calls();
  }
  ASSERT_NE(block, nullptr);
  {
    const AllocationTrap::Scope armed;
    kind.release(block);
    given_back = armed.calls();
  }
  EXPECT_EQ(taken.allocations, kind.seen ? 1U : 0U);
  EXPECT_EQ(taken.frees, 0U);
  EXPECT_EQ(given_back.allocations, 0U);
  EXPECT_EQ(given_back.frees, 1U);
}

INSTANTIATE_TEST_SUITE_P(AllocationTrap, EveryKind, testing::ValuesIn(kinds()),
                         [](const auto& kind) { return kind.param.name; });

TEST(AllocationTrap, SaysWhetherItSeesEverything) {
  EXPECT_EQ(AllocationTrap::is_complete(), kAlignedFormsAreSeen);
}

TEST(AllocationTrap, SeesAReallocThatMoves) {
  void* block = std::malloc(16);
  const AllocationTrap::Scope armed;
  block = keep(std::realloc(block, 1 << 20));
  EXPECT_GE(armed.calls().allocations, 1U);
  std::free(block);
}

TEST(AllocationTrap, SeesAGrowingVector) {
  std::vector<int> numbers;
  const AllocationTrap::Scope armed;
  numbers.push_back(1);
  keep(numbers.data());
  EXPECT_EQ(armed.calls().allocations, 1U);
}

TEST(AllocationTrap, SeesAStringTooLongForItsOwnBuffer) {
  const AllocationTrap::Scope armed;
  std::string text(100, 'x');
  keep(text.data());
  EXPECT_EQ(armed.calls().allocations, 1U);
}

TEST(AllocationTrap, SeesASharedPointer) {
  const AllocationTrap::Scope armed;
  const auto number = std::make_shared<int>(1);
  keep(number.get());
  EXPECT_EQ(armed.calls().allocations, 1U);
}

TEST(AllocationTrap, SaysNothingOfCodeThatLeavesTheHeapAlone) {
  int numbers[100];
  const AllocationTrap::Scope armed;
  for (int& n : numbers) n = 1;
  keep(numbers);
  std::free(nullptr);
  EXPECT_EQ(armed.calls().total(), 0U);
}

TEST(AllocationTrap, DoesNotCountWhenDisarmed) {
  HeapCalls before;
  HeapCalls after;
  {
    const AllocationTrap::Scope outer;
    before = outer.calls();
  }
  std::free(keep(std::malloc(10)));
  {
    const AllocationTrap::Scope outer;
    after = outer.calls();
  }
  EXPECT_EQ(before.total(), 0U);
  EXPECT_EQ(after.total(), 0U);
}

TEST(AllocationTrap, DoesNotCountWhatAnotherThreadDoes) {
  bool go = false;
  HeapCalls seen;
  std::thread other([&go] {
    while (!__atomic_load_n(&go, __ATOMIC_ACQUIRE)) std::this_thread::yield();
    for (int i = 0; i < 100; ++i) std::free(keep(std::malloc(10)));
  });
  {
    const AllocationTrap::Scope armed;
    __atomic_store_n(&go, true, __ATOMIC_RELEASE);
    other.join();
    seen = armed.calls();
  }
  EXPECT_EQ(seen.allocations, 0U);
}

TEST(AllocationTrap, CountsForTheThreadThatArmedIt) {
  HeapCalls seen;
  std::thread other([&seen] {
    const AllocationTrap::Scope armed;
    std::free(keep(std::malloc(10)));
    seen = armed.calls();
  });
  other.join();
  EXPECT_EQ(seen.allocations, 1U);
  EXPECT_EQ(seen.frees, 1U);
}

TEST(AllocationTrap, AnOuterScopeSeesWhatAnInnerOneSaw) {
  const AllocationTrap::Scope outer;
  {
    const AllocationTrap::Scope inner;
    std::free(keep(std::malloc(10)));
    EXPECT_EQ(inner.calls().total(), 2U);
  }
  EXPECT_EQ(outer.calls().total(), 2U);
  std::free(keep(std::malloc(10)));
  EXPECT_EQ(outer.calls().total(), 4U);
}

void allocate_under_the_strict_trap() {
  const AllocationTrap::Scope armed(AllocationTrap::Mode::strict);
  std::free(keep(std::malloc(10)));
}

TEST(AllocationTrapDeathTest, StrictModeNamesTheCulprit) {
  EXPECT_DEATH(allocate_under_the_strict_trap(), "allocation trap: an allocation \\(10 bytes\\)");
}

}  // namespace
}  // namespace dottrack::rtos
