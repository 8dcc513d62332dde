#pragma once
// What every PeriodicTimer promises.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "rtos_shim/clock.h"
#include "rtos_shim/periodic_timer.h"

namespace dottrack::test {

// A timer with a period of kPeriod, the clock it goes by and a way to spend that clock's time.
class TimerBench {
 public:
  static constexpr Duration kPeriod = std::chrono::milliseconds(5);

  TimerBench() = default;
  TimerBench(const TimerBench&) = delete;
  TimerBench& operator=(const TimerBench&) = delete;
  virtual ~TimerBench() = default;

  virtual rtos::PeriodicTimer& timer() = 0;
  virtual const rtos::Clock& clock() const = 0;
  virtual Time start() const = 0;  // of the timer's grid
  virtual void spend(Duration time) = 0;
};

struct TimerCase {
  std::string name;
  std::function<std::unique_ptr<TimerBench>()> make;
};
inline void PrintTo(const TimerCase& made, std::ostream* out) {
  *out << made.name;
}

class PeriodicTimerContract : public testing::TestWithParam<TimerCase> {
 protected:
  std::unique_ptr<TimerBench> bench_ = GetParam().make();
  rtos::PeriodicTimer& timer_ = bench_->timer();
};

}  // namespace dottrack::test
