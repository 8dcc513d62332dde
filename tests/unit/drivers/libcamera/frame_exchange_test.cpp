#include "drivers/libcamera/frame_exchange.h"

#include <gtest/gtest.h>

#include "tests/unit/drivers/libcamera/frame_memory_bench.h"

namespace dottrack::drivers {
namespace {

constexpr std::size_t kBuffers = 4;
constexpr std::size_t kBytes = 12;
constexpr Picture kPicture{
    .packing = Packing::grey, .width_px = 4, .height_px = 3, .stride_bytes = 4};

class Exchange : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(tick_bell_.open());
    ASSERT_TRUE(service_bell_.open());
    begin(true);
  }

  void begin(bool present) { exchange_.begin(shared_.map(kPicture), present); }

  void complete(std::size_t buffer, std::uint32_t sequence,
                Completion::Outcome outcome = Completion::Outcome::frame) {
    exchange_.note_queued();
    exchange_.completed({.outcome = outcome,
                         .buffer = buffer,
                         .bytes_used = kBytes,
                         .sequence = sequence,
                         .mid_exposure = Time(std::chrono::milliseconds(sequence))});
  }

  Arrival pop() {
    Arrival frame;
    EXPECT_TRUE(exchange_.pop(frame));
    return frame;
  }

  test::SharedBuffers shared_{kBuffers, kBytes};
  Doorbell tick_bell_;
  Doorbell service_bell_;
  std::atomic<std::uint64_t> ticks_{0};
  FrameExchange exchange_{tick_bell_, service_bell_, ticks_};
};

TEST_F(Exchange, AFrameGoesToTheTickAndItsBufferBackToTheService) {
  shared_.write(2, std::vector<std::uint8_t>(kBytes, 77));
  complete(2, 5);
  const Arrival frame = pop();
  EXPECT_EQ(frame.buffer, 2);
  EXPECT_EQ(frame.sequence, 5U);
  EXPECT_EQ(frame.mid_exposure, Time(std::chrono::milliseconds(5)));
  EXPECT_EQ(exchange_.image(frame).at(3, 2), 77);
  EXPECT_FALSE(exchange_.next_returned());
  exchange_.give_back(frame);
  EXPECT_EQ(exchange_.next_returned(), 2U);
  EXPECT_FALSE(exchange_.next_returned());
  EXPECT_EQ(exchange_.health().frames, 1U);
}

TEST_F(Exchange, WhatIsNoWholeFrameGoesBackToTheServiceAndIsCounted) {
  complete(0, 1, Completion::Outcome::damaged);
  complete(1, 0, Completion::Outcome::cancelled);
  exchange_.completed({.outcome = Completion::Outcome::frame,
                       .buffer = 2,
                       .bytes_used = kBytes - 1,
                       .sequence = 2,
                       .mid_exposure = {}});
  Arrival frame;
  EXPECT_FALSE(exchange_.pop(frame));
  EXPECT_EQ(exchange_.next_failed(), 0U);
  EXPECT_EQ(exchange_.next_failed(), 1U);
  EXPECT_EQ(exchange_.next_failed(), 2U);
  EXPECT_EQ(exchange_.health().errors, 3U);
  EXPECT_EQ(exchange_.health().gaps, 0U);
  EXPECT_EQ(exchange_.failures_in_row(), 3U);
  complete(3, 3);
  EXPECT_EQ(exchange_.failures_in_row(), 0U);
}

TEST_F(Exchange, SequenceNumbersThatNeverCameAreCounted) {
  complete(0, 3);
  complete(1, 4);
  complete(2, 7);
  EXPECT_EQ(exchange_.health().gaps, 2U);
}

TEST_F(Exchange, BuffersAreWithTheCameraUntilItCompletesThem) {
  exchange_.note_queued();
  exchange_.note_queued();
  EXPECT_EQ(exchange_.with_camera(), 2U);
  exchange_.completed({.outcome = Completion::Outcome::frame,
                       .buffer = 0,
                       .bytes_used = kBytes,
                       .sequence = 0,
                       .mid_exposure = {}});
  exchange_.completed({.outcome = Completion::Outcome::cancelled,
                       .buffer = 1,
                       .bytes_used = 0,
                       .sequence = 0,
                       .mid_exposure = {}});
  EXPECT_EQ(exchange_.with_camera(), 0U);
}

TEST_F(Exchange, ACameraThatLeavesTakesNothingFromTheTick) {
  shared_.write(1, std::vector<std::uint8_t>(kBytes, 42));
  complete(1, 0);
  complete(2, 1);
  const Arrival held = pop();
  exchange_.end();
  EXPECT_FALSE(exchange_.present());
  EXPECT_FALSE(exchange_.reclaim());
  EXPECT_EQ(exchange_.image(held).at(0, 0), 42);
  exchange_.give_back(held);
  EXPECT_FALSE(exchange_.reclaim());
  exchange_.give_back(pop());
  EXPECT_TRUE(exchange_.reclaim());
}

TEST_F(Exchange, WhatCompletesAfterTheEndIsIgnored) {
  exchange_.end();
  complete(0, 0);
  Arrival frame;
  EXPECT_FALSE(exchange_.pop(frame));
  EXPECT_TRUE(exchange_.reclaim());
  EXPECT_EQ(exchange_.health().frames, 0U);
}

TEST_F(Exchange, ACameraThatReturnsIsPresentWithItsFirstFrameAndItsNumbersGoOn) {
  complete(0, 0);
  complete(1, 1);
  exchange_.give_back(pop());
  exchange_.give_back(pop());
  exchange_.end();
  ASSERT_TRUE(exchange_.reclaim());
  EXPECT_EQ(exchange_.health().departures, 1U);
  begin(false);
  EXPECT_FALSE(exchange_.present());
  EXPECT_EQ(exchange_.health().returns, 0U);
  complete(0, 0);
  EXPECT_TRUE(exchange_.present());
  EXPECT_EQ(exchange_.health().returns, 1U);
  EXPECT_EQ(exchange_.health().gaps, 0U);
  EXPECT_EQ(pop().sequence, 2U);
}

TEST_F(Exchange, ACameraThatJoinsLateHasNotReturned) {
  exchange_.end();
  ASSERT_TRUE(exchange_.reclaim());
  FrameExchange late(tick_bell_, service_bell_, ticks_);
  late.begin(shared_.map(kPicture), false);
  late.completed({.outcome = Completion::Outcome::frame,
                  .buffer = 0,
                  .bytes_used = kBytes,
                  .sequence = 0,
                  .mid_exposure = {}});
  EXPECT_TRUE(late.present());
  EXPECT_EQ(late.health().returns, 0U);
}

TEST_F(Exchange, SilenceIsCountedInTicksAndEndsWithAFrame) {
  ticks_ = 12;
  EXPECT_EQ(exchange_.silence(), 12U);
  exchange_.note_silence();
  exchange_.note_silence();
  EXPECT_FALSE(exchange_.present());
  EXPECT_EQ(exchange_.health().departures, 1U);
  complete(0, 9);
  EXPECT_EQ(exchange_.silence(), 0U);
  EXPECT_TRUE(exchange_.present());
  EXPECT_EQ(exchange_.health().returns, 1U);
}

}  // namespace
}  // namespace dottrack::drivers
