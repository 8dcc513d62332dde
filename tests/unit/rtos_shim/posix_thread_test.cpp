#include "rtos_shim/posix_rt/posix_thread.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "tests/unit/rtos_shim/privileges.h"

namespace dottrack::rtos {
namespace {

// What a thread finds out about itself.
struct Portrait {
  std::array<char, 16> name{};
  cpu_set_t cpus{};
  int policy = -1;
  sched_param priority{};
  std::uintptr_t stack = 0;  // its lowest address
  std::size_t stack_bytes = 0;
};

Portrait portrait_of_this_thread() {
  Portrait seen;
  pthread_getname_np(pthread_self(), seen.name.data(), seen.name.size());
  sched_getaffinity(0, sizeof seen.cpus, &seen.cpus);
  pthread_getschedparam(pthread_self(), &seen.policy, &seen.priority);
  pthread_attr_t attributes;
  pthread_getattr_np(pthread_self(), &attributes);
  void* lowest = nullptr;
  pthread_attr_getstack(&attributes, &lowest, &seen.stack_bytes);
  seen.stack = reinterpret_cast<std::uintptr_t>(lowest);
  pthread_attr_destroy(&attributes);
  return seen;
}

Portrait portrait_with(const ThreadSettings& settings) {
  Portrait seen;
  PosixThread thread;
  const auto started = thread.start(settings, [&seen] { seen = portrait_of_this_thread(); });
  EXPECT_TRUE(started) << started.error().message;
  thread.join();
  return seen;
}

ThreadSettings named(const char* name) {
  ThreadSettings settings;
  settings.name = name;
  return settings;
}

int last_cpu() {
  cpu_set_t cpus;
  sched_getaffinity(0, sizeof cpus, &cpus);
  int last = CPU_SETSIZE - 1;
  while (!CPU_ISSET(static_cast<std::size_t>(last), &cpus)) --last;
  return last;
}

bool may_have_priority(int priority) {
  ThreadSettings settings = named("trial");
  settings.fifo_priority = priority;
  return PosixThread().start(settings, [] {}).has_value();
}

TEST(PosixThread, GoesByItsName) {
  EXPECT_STREQ(portrait_with(named("fifteen letters")).name.data(), "fifteen letters");
}

TEST(PosixThread, RunsOnTheProcessorAskedForAndNoOther) {
  ThreadSettings settings = named("pinned");
  settings.cpu = last_cpu();
  const Portrait seen = portrait_with(settings);
  EXPECT_EQ(CPU_COUNT(&seen.cpus), 1);
  EXPECT_TRUE(CPU_ISSET(static_cast<std::size_t>(*settings.cpu), &seen.cpus));
}

TEST(PosixThread, IsNotBoundToTheProcessorOfTheThreadThatStartsIt) {
  ThreadSettings settings = named("pinned");
  settings.cpu = last_cpu();
  Portrait seen;
  PosixThread pinned;
  ASSERT_TRUE(pinned.start(settings, [&seen] { seen = portrait_with(named("free")); }));
  pinned.join();
  const Portrait here = portrait_of_this_thread();
  EXPECT_TRUE(CPU_EQUAL(&seen.cpus, &here.cpus));
}

TEST(PosixThread, HasThePriorityAskedFor) {
  if (!may_have_priority(7)) GTEST_SKIP() << "no permission for real-time priorities here";
  ThreadSettings settings = named("urgent");
  settings.fifo_priority = 7;
  const Portrait seen = portrait_with(settings);
  EXPECT_EQ(seen.policy, SCHED_FIFO);
  EXPECT_EQ(seen.priority.sched_priority, 7);
}

TEST(PosixThread, DoesNotInheritThePriorityOfTheThreadThatStartsIt) {
  if (!may_have_priority(7)) GTEST_SKIP() << "no permission for real-time priorities here";
  ThreadSettings settings = named("urgent");
  settings.fifo_priority = 7;
  Portrait seen;
  PosixThread urgent;
  ASSERT_TRUE(urgent.start(settings, [&seen] { seen = portrait_with(named("ordinary")); }));
  urgent.join();
  EXPECT_EQ(seen.policy, SCHED_OTHER);
}

TEST(PosixThread, HasAStackOfTheSizeAskedForInMemoryFromTheStart) {
  constexpr std::size_t kPage = 4096;
  constexpr std::size_t kMostPages = 16 * 1024;
  ThreadSettings settings = named("deep");
  settings.stack_bytes = 3 * 1024 * 1024 + 1;
  std::size_t size = 0;
  std::size_t resident = 0;
  std::vector<unsigned char> pages(kMostPages);
  PosixThread thread;
  ASSERT_TRUE(thread.start(settings, [&] {
    const Portrait seen = portrait_of_this_thread();
    size = seen.stack_bytes;
    if (size / kPage > pages.size()) return;
    mincore(reinterpret_cast<void*>(seen.stack), size, pages.data());
    for (std::size_t page = 0; page < size / kPage; ++page) resident += pages[page] & 1U;
  }));
  thread.join();
  EXPECT_GE(size, settings.stack_bytes);
  EXPECT_EQ(resident, size / kPage);
}

// Ends the process with what start() said.
[[noreturn]] void ask_for_priority_without_permission() {
  if (!test::drop_capabilities() || !test::limit(RLIMIT_RTPRIO, 0)) std::_Exit(3);
  ThreadSettings settings = named("dottrack-loop");
  settings.fifo_priority = 80;
  PosixThread thread;
  const auto started = thread.start(settings, [] { std::_Exit(2); });
  std::fputs(started ? "started" : started.error().message.c_str(), stderr);
  std::_Exit(0);
}

TEST(PosixThreadDeathTest, WithoutPermissionThePriorityIsAnErrorThatSaysWhatIsMissing) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(ask_for_priority_without_permission(), testing::ExitedWithCode(0),
              "^thread dottrack-loop: no permission for real-time priority 80; "
              "expected RLIMIT_RTPRIO of at least 80 or CAP_SYS_NICE$");
}

}  // namespace
}  // namespace dottrack::rtos
