#pragma once
// What every Clock promises.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "rtos_shim/clock.h"

namespace dottrack::test {

struct ClockCase {
  std::string name;
  std::function<std::unique_ptr<rtos::Clock>()> make;
};
inline void PrintTo(const ClockCase& made, std::ostream* out) {
  *out << made.name;
}

class ClockContract : public testing::TestWithParam<ClockCase> {
 protected:
  std::unique_ptr<rtos::Clock> clock_ = GetParam().make();
};

}  // namespace dottrack::test
