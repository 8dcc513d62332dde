#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "drivers/libcamera/frame_exchange.h"
#include "tests/unit/drivers/libcamera/frame_memory_bench.h"

namespace dottrack::drivers {
namespace {

constexpr std::size_t kBuffers = 4;
constexpr std::size_t kBytes = 4;
constexpr Picture kPicture{
    .packing = Packing::yuyv, .width_px = 2, .height_px = 1, .stride_bytes = 4};
constexpr std::uint32_t kFramesARun = 2000;
constexpr int kRuns = 5;
constexpr Duration kPatience = std::chrono::milliseconds(1);

// What the camera was handed.
using Queue = rtos::SpscRing<std::uint8_t, FrameExchange::kMaxBuffers>;

// A camera, its service and a tick, each in a thread of its own, through departures and returns.
class Traffic : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(tick_bell_.open());
    ASSERT_TRUE(service_bell_.open());
  }

  // One run of the camera; the frames carry their number.
  void camera() {
    for (std::uint32_t sequence = 0; sequence < kFramesARun;) {
      std::uint8_t buffer = 0;
      if (!queue_.try_pop(buffer)) {
        std::this_thread::yield();
        continue;
      }
      const auto low = static_cast<std::uint8_t>(sequence);
      shared_.write(buffer, std::array<std::uint8_t, kBytes>{low, 0, low, 0});
      exchange_.note_queued();
      exchange_.completed({.outcome = Completion::Outcome::frame,
                           .buffer = buffer,
                           .bytes_used = kBytes,
                           .sequence = sequence,
                           .mid_exposure = Time(Duration(sequence))});
      ++sequence;
    }
  }

  void service() {
    for (int run = 0; run < kRuns; ++run) {
      exchange_.begin(shared_.map(kPicture), run == 0);
      for (std::uint8_t buffer = 0; buffer < kBuffers; ++buffer) (void)queue_.try_push(buffer);
      std::atomic<bool> done = false;
      std::thread source([&] {
        camera();
        done = true;
      });
      while (!done) {
        service_bell_.wait(kPatience);
        while (const auto buffer = exchange_.next_returned()) {
          (void)queue_.try_push(static_cast<std::uint8_t>(*buffer));
        }
      }
      source.join();
      exchange_.end();
      while (!exchange_.reclaim()) service_bell_.wait(kPatience);
      std::uint8_t left = 0;
      while (queue_.try_pop(left)) {
      }
    }
    closed_ = true;
  }

  test::SharedBuffers shared_{kBuffers, kBytes};
  Doorbell tick_bell_;
  Doorbell service_bell_;
  std::atomic<std::uint64_t> ticks_{0};
  FrameExchange exchange_{tick_bell_, service_bell_, ticks_};
  Queue queue_;
  std::atomic<bool> closed_{false};
};

TEST_F(Traffic, EveryFrameArrivesOnceInOrderWithItsOwnPicture) {
  std::thread service_thread([this] { service(); });
  std::uint32_t next = 0;
  while (!closed_) {
    tick_bell_.wait(kPatience);
    ++ticks_;
    Arrival frame;
    while (exchange_.pop(frame)) {
      ASSERT_EQ(frame.sequence, next);
      ASSERT_EQ(exchange_.image(frame).at(1, 0), static_cast<std::uint8_t>(next % kFramesARun));
      ++next;
      exchange_.give_back(frame);
      service_bell_.ring();
    }
  }
  service_thread.join();
  EXPECT_EQ(next, kRuns * kFramesARun);
  EXPECT_EQ(exchange_.health().frames, kRuns * kFramesARun);
  EXPECT_EQ(exchange_.health().departures, static_cast<std::uint64_t>(kRuns));
  EXPECT_EQ(exchange_.health().returns, static_cast<std::uint64_t>(kRuns - 1));
  EXPECT_EQ(exchange_.health().errors, 0U);
}

}  // namespace
}  // namespace dottrack::drivers
