#pragma once
// A thread with the scheduling it asks for.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "hal/base/result.h"

namespace dottrack::rtos {

struct ThreadSettings {
  std::string name;                       // at most 15 characters
  std::optional<int> fifo_priority = {};  // 1 (lowest) to 99; none: ordinary scheduling
  std::optional<int> cpu = {};            // the one processor it may run on; none: any
  std::size_t stack_bytes = 256 * 1024;   // fixed; touched whole before the body runs
};

// Contract: start() runs `body` once, on a thread of its own, with exactly these settings, or
// returns an error and runs nothing: a setting is never quietly lowered. join() waits for the body
// to return; the destructor joins. Start-up only: both may allocate and block.
class Thread {
 public:
  Thread() = default;
  Thread(const Thread&) = delete;
  Thread& operator=(const Thread&) = delete;
  virtual ~Thread() = default;

  Result<void> start(const ThreadSettings& settings, std::function<void()> body) {
    return do_start(settings, std::move(body));
  }
  void join() { do_join(); }

 private:
  virtual Result<void> do_start(const ThreadSettings& settings, std::function<void()> body) = 0;
  virtual void do_join() = 0;
};

}  // namespace dottrack::rtos
