#include "tests/contract/iris_contract.h"

#include "hal/base/camera_set.h"
#include "rtos_shim/allocation_trap/allocation_trap.h"

namespace dottrack::test {
namespace {

TEST_P(IrisContract, TheOpeningIsAlwaysBetweenClosedAndOpen) {
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    const hal::IrisState state = iris_->state(camera);
    EXPECT_GE(state.opening, 0.0);
    EXPECT_LE(state.opening, 1.0);
  }
}

TEST_P(IrisContract, ARefusedRequestLeavesTheLensInCharge) {
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    const bool taken = iris_->move_to(camera, 0.5);
    EXPECT_EQ(iris_->state(camera).automatic, !taken);
  }
}

TEST_P(IrisContract, LeavesTheHeapAlone) {
  const rtos::AllocationTrap::Scope armed;
  iris_->move_to(0, 0.25);
  iris_->state(0);
  iris_->release_to_auto(0);
  EXPECT_EQ(armed.calls().total(), 0U);
}

}  // namespace
}  // namespace dottrack::test
