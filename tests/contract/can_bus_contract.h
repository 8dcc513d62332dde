#pragma once
// What every CanBus promises.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "hal/can_bus.h"

namespace dottrack::test {

// A bus in good order with nobody else on it, and an ear on what goes out.
class CanBench {
 public:
  CanBench() = default;
  CanBench(const CanBench&) = delete;
  CanBench& operator=(const CanBench&) = delete;
  virtual ~CanBench() = default;

  virtual hal::CanBus& bus() = 0;
  virtual Time now() const = 0;
  virtual std::vector<hal::CanFrame> heard() = 0;  // since the last call, in order
};

struct CanCase {
  std::string name;
  std::function<std::unique_ptr<CanBench>()> make;
};
inline void PrintTo(const CanCase& made, std::ostream* out) {
  *out << made.name;
}

class CanBusContract : public testing::TestWithParam<CanCase> {
 protected:
  hal::SendResult send(const hal::CanFrame& frame) {
    return bus_.send(frame, bench_->now() + std::chrono::milliseconds(100));
  }

  std::unique_ptr<CanBench> bench_ = GetParam().make();
  hal::CanBus& bus_ = bench_->bus();
};

}  // namespace dottrack::test
