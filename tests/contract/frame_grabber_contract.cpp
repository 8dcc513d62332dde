#include "tests/contract/frame_grabber_contract.h"

#include "rtos_shim/allocation_trap/allocation_trap.h"

namespace dottrack::test {
namespace {

TEST_P(FrameGrabberContract, CamerasThatDeliverAreThereWithImages) {
  const hal::FrameSet& set = grab(kAll, kAll);
  ASSERT_EQ(set.delivered, kAll);
  for (std::size_t i = 0; i < GrabberBench::kCameras; ++i) {
    const ImageView& image = set.frames[i].image;
    ASSERT_FALSE(image.empty());
    EXPECT_EQ(image.width_px, GrabberBench::kWidth_px);
    EXPECT_EQ(image.height_px, GrabberBench::kHeight_px);
    EXPECT_GE(image.stride_bytes, image.width_px);
  }
}

TEST_P(FrameGrabberContract, ACameraThatDoesNotDeliverIsMissingAndTheOthersAreThere) {
  const CameraSet without_1(0b101);
  EXPECT_EQ(grab(without_1, kAll).delivered, without_1);
}

TEST_P(FrameGrabberContract, NobodyDeliveringIsAnAnswerToo) {
  EXPECT_TRUE(grab(CameraSet{}, kAll).delivered.empty());
}

TEST_P(FrameGrabberContract, OnlyExpectedCamerasAreInTheSet) {
  const CameraSet only_2(0b100);
  EXPECT_EQ(grab(kAll, only_2).delivered, only_2);
}

TEST_P(FrameGrabberContract, ADeadlineThatIsPastIsNotWaitedFor) {
  bench_->prepare(CameraSet{});
  const Time now = bench_->now();
  grabber_.trigger(now);
  EXPECT_TRUE(grabber_.await(kAll, now - kPatience).delivered.empty());
}

TEST_P(FrameGrabberContract, AMissingCameraIsBackInTheNextTick) {
  grab(CameraSet(0b011), kAll);
  grabber_.release();
  EXPECT_EQ(grab(kAll, kAll).delivered, kAll);
}

TEST_P(FrameGrabberContract, AFrameIsNotDeliveredTwice) {
  grab(kAll, kAll);
  grabber_.release();
  EXPECT_TRUE(grab(CameraSet{}, kAll).delivered.empty());
}

TEST_P(FrameGrabberContract, TheSequenceCountsTriggersSoThatAGapIsALostFrame) {
  const std::uint32_t first = grab(kAll, kAll).frames[0].sequence;
  grabber_.release();
  grab(CameraSet(0b110), kAll);
  grabber_.release();
  EXPECT_EQ(grab(kAll, kAll).frames[0].sequence, first + 2);
}

TEST_P(FrameGrabberContract, TheExposureLiesBetweenTriggerAndDelivery) {
  const hal::FrameSet& set = grab(kAll, kAll);
  const Time delivered = bench_->now();
  for (std::size_t i = 0; i < GrabberBench::kCameras; ++i) {
    EXPECT_GE(set.frames[i].mid_exposure, triggered_);
    EXPECT_LE(set.frames[i].mid_exposure, delivered);
  }
}

TEST_P(FrameGrabberContract, ATickLeavesTheHeapAlone) {
  bench_->prepare(kAll);
  const Time now = bench_->now();
  const rtos::AllocationTrap::Scope armed;
  grabber_.trigger(now);
  const hal::FrameSet& set = grabber_.await(kAll, now + kPatience);
  const CameraSet delivered = set.delivered;
  grabber_.release();
  EXPECT_EQ(armed.calls().total(), 0U);
  EXPECT_EQ(delivered, kAll);
}

}  // namespace
}  // namespace dottrack::test
