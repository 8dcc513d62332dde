#pragma once
// A thread of the operating system with its scheduling, processor and stack in force.

#include <pthread.h>

#include <semaphore>

#include "rtos_shim/thread.h"

namespace dottrack::rtos {

// SCHED_FIFO for a priority, ordinary scheduling for none, whatever the starting thread has. The
// thread puts its settings in force itself, looks whether they are, and only then runs the body. A
// start() that failed leaves the object as it was: it may be tried again with fewer settings.
// A stack also holds the C library's own data of the thread, a few KiB; and it may be larger than
// asked for, when the library has one left over from a thread that has ended.
class PosixThread final : public Thread {
 public:
  PosixThread() = default;
  ~PosixThread() override;

 private:
  Result<void> do_start(const ThreadSettings& settings, std::function<void()> body) override;
  void do_join() override;

  Result<void> create();
  static void* enter(void* thread);
  void run();

  ThreadSettings settings_;
  std::function<void()> body_;
  Result<void> outcome_;  // of the settings; written before settled_, read after it
  std::binary_semaphore settled_{0};
  pthread_t handle_{};
  bool running_ = false;
};

}  // namespace dottrack::rtos
