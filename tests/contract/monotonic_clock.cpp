#include "rtos_shim/posix_rt/monotonic_clock.h"

#include "tests/contract/clock_contract.h"

namespace dottrack::test {
namespace {

INSTANTIATE_TEST_SUITE_P(Monotonic, ClockContract,
                         testing::Values(ClockCase{
                             "clock", [] { return std::make_unique<rtos::MonotonicClock>(); }}));

}  // namespace
}  // namespace dottrack::test
