#include "tests/contract/thread_contract.h"

#include <gmock/gmock.h>

#include <chrono>
#include <semaphore>
#include <thread>
#include <vector>

namespace dottrack::test {
namespace {

using rtos::ThreadSettings;
using testing::HasSubstr;
using testing::Not;

std::vector<ThreadSettings> impossible() {
  std::vector<ThreadSettings> all(7);
  all[0].cpu = 4096;
  all[1].cpu = -1;
  all[2].name = "sixteen letters.";
  all[3].fifo_priority = 0;
  all[4].fifo_priority = 100;
  all[5].stack_bytes = 1;
  all[6].stack_bytes = std::size_t{1} << 60U;
  for (ThreadSettings& settings : all) {
    if (settings.name.empty()) settings.name = "impossible";
  }
  return all;
}

TEST_P(ThreadContract, RunsTheBodyOnceOnAThreadOfItsOwn) {
  std::thread::id runner;
  const auto started = thread_->start(plain(), [&] {
    runner = std::this_thread::get_id();
    ++runs_;
  });
  ASSERT_TRUE(started) << started.error().message;
  thread_->join();
  EXPECT_EQ(runs_, 1);
  EXPECT_NE(runner, std::this_thread::get_id());
}

TEST_P(ThreadContract, StartDoesNotWaitForTheBodyAndJoinDoes) {
  std::binary_semaphore go{0};
  ASSERT_TRUE(thread_->start(plain(), [&] {
    go.acquire();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ++runs_;
  }));
  EXPECT_EQ(runs_, 0);
  go.release();
  thread_->join();
  EXPECT_EQ(runs_, 1);
}

TEST_P(ThreadContract, TheDestructorJoins) {
  ASSERT_TRUE(thread_->start(plain(), [&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ++runs_;
  }));
  thread_.reset();
  EXPECT_EQ(runs_, 1);
}

TEST_P(ThreadContract, JoiningWhatNeverStartedOrHasEndedReturnsAtOnce) {
  thread_->join();
  ASSERT_TRUE(thread_->start(plain(), count()));
  thread_->join();
  thread_->join();
  EXPECT_EQ(runs_, 1);
}

TEST_P(ThreadContract, ASettingThatCannotBeHadIsAnErrorOfOneLineAndNothingRuns) {
  for (const ThreadSettings& settings : impossible()) {
    const auto started = thread_->start(settings, count());
    thread_->join();
    ASSERT_FALSE(started);
    EXPECT_THAT(started.error().message, HasSubstr("thread " + settings.name + ": "));
    EXPECT_THAT(started.error().message, HasSubstr("; expected "));
    EXPECT_THAT(started.error().message, Not(HasSubstr("\n")));
  }
  EXPECT_EQ(runs_, 0);
}

TEST_P(ThreadContract, AfterAnErrorItMayBeTriedWithFewerSettings) {
  ThreadSettings settings = plain();
  settings.cpu = 4096;
  ASSERT_FALSE(thread_->start(settings, count()));
  ASSERT_TRUE(thread_->start(plain(), count()));
  thread_->join();
  EXPECT_EQ(runs_, 1);
}

TEST_P(ThreadContract, WhatIsRunningCannotBeStartedAndIsNotDisturbed) {
  std::binary_semaphore go{0};
  ASSERT_TRUE(thread_->start(plain(), [&] {
    go.acquire();
    ++runs_;
  }));
  EXPECT_FALSE(thread_->start(plain(), count()));
  go.release();
  thread_->join();
  EXPECT_EQ(runs_, 1);
}

}  // namespace
}  // namespace dottrack::test
