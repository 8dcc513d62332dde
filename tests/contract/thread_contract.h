#pragma once
// What every Thread promises.

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "rtos_shim/thread.h"

namespace dottrack::test {

struct ThreadCase {
  std::string name;
  std::function<std::unique_ptr<rtos::Thread>()> make;
};
inline void PrintTo(const ThreadCase& made, std::ostream* out) {
  *out << made.name;
}

class ThreadContract : public testing::TestWithParam<ThreadCase> {
 protected:
  static rtos::ThreadSettings plain() {
    rtos::ThreadSettings settings;
    settings.name = "contract";
    return settings;
  }
  std::function<void()> count() {
    return [this] { ++runs_; };
  }

  std::atomic<int> runs_ = 0;
  std::unique_ptr<rtos::Thread> thread_ = GetParam().make();
};

}  // namespace dottrack::test
