#include "drivers/socketcan/socket_can_bus.h"

#include "rtos_shim/posix_rt/monotonic_clock.h"
#include "tests/contract/can_bus_contract.h"
#include "tests/support/can_pair.h"

namespace dottrack::test {
namespace {

class SocketPairBench final : public CanBench {
 public:
  explicit SocketPairBench(bool fd) : bus_(pair_.channel(fd, clock_)) {}

  hal::CanBus& bus() override { return bus_; }
  Time now() const override { return clock_.now(); }
  std::vector<hal::CanFrame> heard() override { return pair_.heard(); }

 private:
  rtos::MonotonicClock clock_;
  CanPair pair_;
  drivers::SocketCanBus bus_;
};

CanCase over_a_pair(const std::string& name, bool fd) {
  return {name, [fd] { return std::make_unique<SocketPairBench>(fd); }};
}

INSTANTIATE_TEST_SUITE_P(SocketCan, CanBusContract,
                         testing::Values(over_a_pair("classic", false), over_a_pair("fd", true)));

}  // namespace
}  // namespace dottrack::test
