#include "host_sim/hal/sim_can_bus.h"

#include "tests/contract/can_bus_contract.h"
#include "tests/support/listening_can_bus.h"

namespace dottrack::test {
namespace {

class SimulatedBench final : public CanBench {
 public:
  hal::CanBus& bus() override { return bus_; }
  Time now() const override { return clock_.now(); }
  std::vector<hal::CanFrame> heard() override { return log_.take(); }

 private:
  rtos::VirtualClock clock_;
  ListeningCanBus log_;
  host_sim::SimCanBus bus_{{}, 1, clock_, log_};
};

INSTANTIATE_TEST_SUITE_P(Simulated, CanBusContract,
                         testing::Values(CanCase{
                             "can_bus", [] { return std::make_unique<SimulatedBench>(); }}));

}  // namespace
}  // namespace dottrack::test
