#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "drivers/libgpiod/gpio_iris.h"
#include "rtos_shim/virtual_time/virtual_clock.h"
#include "tests/support/memory_line_banks.h"

namespace dottrack::test {
namespace {

// One thread asks, one steps, one looks; the newest request is where it ends.
TEST(GpioIrisThreads, RequestsAndStatesCrossThreads) {
  const rtos::VirtualClock clock;
  MemoryLineBanks banks;
  banks.add("steppers", 4);
  const drivers::IrisWiring wiring{.name = "cam0",
                                   .chip = "steppers",
                                   .step_line = 0,
                                   .direction_line = 1,
                                   .enable_line = {},
                                   .auto_line = {},
                                   .end_stop_line = {},
                                   .travel_steps = 50};
  const auto iris = *drivers::GpioIris::open({wiring}, clock, banks);
  std::atomic<bool> done = false;
  std::thread stepper([&] {
    Time now{};
    while (!done) iris->advance(now += iris->step_period());
  });
  std::atomic<int> outside = 0;
  std::thread looker([&] {
    while (!done) {
      const double opening = iris->state(0).opening;
      if (opening < 0.0 || opening > 1.0) ++outside;
      std::this_thread::yield();
    }
  });
  for (int i = 0; i < 2000; ++i) {
    ASSERT_TRUE(iris->move_to(0, (i % 50) / 50.0));
    if (i % 100 == 99) iris->release_to_auto(0);
  }
  iris->move_to(0, 0.5);
  while (iris->state(0).moving) std::this_thread::yield();
  EXPECT_DOUBLE_EQ(iris->state(0).opening, 0.5);
  done = true;
  stepper.join();
  looker.join();
  EXPECT_EQ(outside, 0);
}

}  // namespace
}  // namespace dottrack::test
