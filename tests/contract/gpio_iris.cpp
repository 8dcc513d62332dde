#include "drivers/libgpiod/gpio_iris.h"

#include "rtos_shim/virtual_time/virtual_clock.h"
#include "tests/contract/iris_contract.h"
#include "tests/support/memory_line_banks.h"

namespace dottrack::test {
namespace {

std::vector<std::optional<drivers::IrisWiring>> twelve_irises() {
  std::vector<std::optional<drivers::IrisWiring>> irises;
  for (unsigned i = 0; i < 12; ++i) {
    irises.push_back(drivers::IrisWiring{.name = "cam" + std::to_string(i),
                                         .chip = "steppers",
                                         .step_line = 4 * i,
                                         .direction_line = 4 * i + 1,
                                         .enable_line = 4 * i + 2,
                                         .auto_line = 4 * i + 3,
                                         .end_stop_line = {},
                                         .travel_steps = 50});
  }
  return irises;
}

std::unique_ptr<hal::Iris> make_irises() {
  static const rtos::VirtualClock kClock;
  static MemoryLineBanks banks;
  static const MemoryChip& chip = banks.add("steppers", 48);
  EXPECT_EQ(chip.chip.label, "steppers");
  return *drivers::GpioIris::open(twelve_irises(), kClock, banks);
}

INSTANTIATE_TEST_SUITE_P(Gpio, IrisContract, testing::Values(IrisCase{"irises", make_irises}));

}  // namespace
}  // namespace dottrack::test
