#include "rtos_shim/posix_rt/posix_memory_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "tests/unit/rtos_shim/privileges.h"

namespace dottrack::rtos {
namespace {

using testing::HasSubstr;

// Sanitizers have the heap in their hands and take mlockall for done.
#if defined(DOTTRACK_SANITIZES_ADDRESS) || defined(DOTTRACK_SANITIZES_THREAD)
constexpr bool kMemoryIsOurs = false;
#else
constexpr bool kMemoryIsOurs = true;
#endif

constexpr std::size_t kStack_bytes = 1024 * 1024;
constexpr std::size_t kBlock_bytes = 16 * 1024 * 1024;
constexpr int kNoPermission = 77;

[[noreturn]] void end(const std::string& said, int status = 0) {
  std::fputs(said.c_str(), stderr);
  std::_Exit(status);
}

bool lock() {
  return PosixMemoryLock().lock_all(kStack_bytes).has_value();
}

long locked_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmLck:")) return std::atol(line.c_str() + std::strlen("VmLck:"));
  }
  return -1;
}

long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

void use(std::size_t bytes) {
  auto* block = static_cast<volatile char*>(std::malloc(bytes));
  for (std::size_t i = 0; i < bytes; i += 4096) block[i] = 1;
  std::free(const_cast<char*>(block));
}

[[gnu::noinline]] void use_stack() {
  volatile char room[kStack_bytes / 2];
  for (std::size_t i = 0; i < sizeof room; i += 512) room[i] = 1;
}

TEST(PosixMemoryLock, AStackThatIsNotThereIsAnErrorAndNothingIsLocked) {
  const long before = locked_kib();
  const auto locked = PosixMemoryLock().lock_all(std::size_t{1} << 50U);
  ASSERT_FALSE(locked);
  EXPECT_THAT(locked.error().message, HasSubstr("memory: no 1099511627776 KiB of stack"));
  EXPECT_THAT(locked.error().message, HasSubstr("; expected at most "));
  EXPECT_EQ(locked_kib(), before);
}

// Locking cannot be undone for what the C library remembers, so each of these has a process of its
// own. They print what they found; without permission they have nothing to find.
class PosixMemoryLockDeathTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!kMemoryIsOurs) GTEST_SKIP() << "a sanitizer keeps the memory";
    GTEST_FLAG_SET(death_test_style, "threadsafe");
  }
};

testing::AssertionResult done_or_not_permitted(int status) {
  const bool fine =
      WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == kNoPermission);
  return fine ? testing::AssertionSuccess() : testing::AssertionFailure() << "status " << status;
}

[[noreturn]] void lock_and_tell_what_is_locked() {
  if (!lock()) end("no permission", kNoPermission);
  end(locked_kib() > 1000 ? "locked" : "not locked");
}

TEST_F(PosixMemoryLockDeathTest, WhatTheProcessHasIsLocked) {
  EXPECT_EXIT(lock_and_tell_what_is_locked(), done_or_not_permitted, "^(locked|no permission)$");
}

[[noreturn]] void lock_and_count_faults() {
  if (!lock()) end("no permission", kNoPermission);
  use(kBlock_bytes);
  const long before = page_faults();
  use(kBlock_bytes);
  use_stack();
  const long faults = page_faults() - before;
  end(faults < 10 ? "few faults" : "faults: " + std::to_string(faults));
}

// 4096 pages of heap and 128 of stack.
TEST_F(PosixMemoryLockDeathTest, MemoryUsedOnceIsNotFetchedAgain) {
  EXPECT_EXIT(lock_and_count_faults(), done_or_not_permitted, "^(few faults|no permission)$");
}

[[noreturn]] void lock_without_permission(rlim_t limit_bytes) {
  if (!test::drop_capabilities() || !test::limit(RLIMIT_MEMLOCK, limit_bytes)) end("?", 3);
  const auto locked = PosixMemoryLock().lock_all(kStack_bytes);
  end(locked ? "locked" : locked.error().message);
}

TEST_F(PosixMemoryLockDeathTest, WithoutPermissionTheErrorNamesTheLimit) {
  EXPECT_EXIT(lock_without_permission(64 * 1024), testing::ExitedWithCode(0),
              "^memory: cannot be locked: .*; RLIMIT_MEMLOCK is 64 KiB; "
              "expected unlimited or CAP_IPC_LOCK$");
  EXPECT_EXIT(lock_without_permission(0), testing::ExitedWithCode(0), "RLIMIT_MEMLOCK is 0 KiB");
}

}  // namespace
}  // namespace dottrack::rtos
