#include "host_sim/hal/sim_iris.h"

#include "rtos_shim/virtual_time/virtual_clock.h"
#include "tests/contract/iris_contract.h"

namespace dottrack::test {
namespace {

std::unique_ptr<hal::Iris> make_irises() {
  static const rtos::VirtualClock kClock;
  return std::make_unique<host_sim::SimIris>(12, host_sim::IrisModel{}, kClock);
}

INSTANTIATE_TEST_SUITE_P(Simulated, IrisContract, testing::Values(IrisCase{"irises", make_irises}));

}  // namespace
}  // namespace dottrack::test
