#pragma once
// What every Watchdog promises.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "rtos_shim/watchdog.h"

namespace dottrack::test {

// A watchdog with a timeout of kTimeout, time to spend, and a look at what it does at the end of
// it.
class WatchdogBench {
 public:
  static constexpr Duration kTimeout = std::chrono::seconds(4);

  WatchdogBench() = default;
  WatchdogBench(const WatchdogBench&) = delete;
  WatchdogBench& operator=(const WatchdogBench&) = delete;
  virtual ~WatchdogBench() = default;

  virtual rtos::Watchdog& watchdog() = 0;
  virtual void spend(Duration time) = 0;
  virtual bool bitten() const = 0;  // the unit would have been restarted by now
};

struct WatchdogCase {
  std::string name;
  std::function<std::unique_ptr<WatchdogBench>()> make;
};
inline void PrintTo(const WatchdogCase& made, std::ostream* out) {
  *out << made.name;
}

class WatchdogContract : public testing::TestWithParam<WatchdogCase> {
 protected:
  std::unique_ptr<WatchdogBench> bench_ = GetParam().make();
  rtos::Watchdog& watchdog_ = bench_->watchdog();
};

}  // namespace dottrack::test
