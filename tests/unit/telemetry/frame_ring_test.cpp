#include "app/telemetry/frame_ring.h"

#include <gtest/gtest.h>

#include <vector>

#include "rtos_shim/allocation_trap/allocation_trap.h"

namespace dottrack::telemetry {
namespace {

constexpr int kWidth = 4;
constexpr int kHeight = 3;
constexpr int kStride = 7;

class FrameRingTest : public testing::Test {
 protected:
  // Two cameras; pixel (x, y) of camera c is 100 c + 10 y + x + brightness.
  hal::FrameSet frames(int brightness) {
    hal::FrameSet set;
    for (std::size_t c = 0; c < 2; ++c) {
      pixels_[c].assign(kStride * kHeight, 255);
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          pixels_[c][static_cast<std::size_t>(y * kStride + x)] =
              static_cast<std::uint8_t>(100 * static_cast<int>(c) + 10 * y + x + brightness);
        }
      }
      set.frames[c] = {{pixels_[c].data(), kWidth, kHeight, kStride},
                       Time(Duration(500 + static_cast<Duration::rep>(c))),
                       9};
      set.delivered.insert(c);
    }
    return set;
  }

  std::array<std::vector<std::uint8_t>, 2> pixels_;
  std::vector<FrameSize> sizes_{{kWidth, kHeight}, {kWidth, kHeight}};
  FrameRing ring_{sizes_, 3};
};

TEST_F(FrameRingTest, GivesBackCopiesInOrder) {
  ASSERT_TRUE(ring_.try_push(7, Time(Duration(1000)), frames(0)));
  ASSERT_TRUE(ring_.try_push(8, Time(Duration(2000)), frames(50)));
  pixels_[0].assign(pixels_[0].size(), 0);  // the camera's buffer is used again
  const FrameCopy* copy = ring_.front();
  ASSERT_NE(copy, nullptr);
  EXPECT_EQ(copy->tick, 7U);
  EXPECT_EQ(copy->copied, Time(Duration(1000)));
  EXPECT_EQ(copy->delivered.size(), 2);
  EXPECT_EQ(copy->frames[1].mid_exposure, Time(Duration(501)));
  EXPECT_EQ(copy->frames[0].image.at(3, 2), 23);
  EXPECT_EQ(copy->frames[1].image.at(1, 0), 101);
  ring_.pop();
  ASSERT_NE(ring_.front(), nullptr);
  EXPECT_EQ(ring_.front()->frames[0].image.at(0, 1), 60);
  ring_.pop();
  EXPECT_EQ(ring_.front(), nullptr);
}

TEST_F(FrameRingTest, AFullRingRefusesAndLosesNothing) {
  for (std::uint64_t tick = 0; tick < 3; ++tick) ASSERT_TRUE(ring_.try_push(tick, {}, frames(0)));
  EXPECT_FALSE(ring_.try_push(3, {}, frames(9)));
  EXPECT_EQ(ring_.front()->tick, 0U);
  ring_.pop();
  EXPECT_TRUE(ring_.try_push(4, {}, frames(0)));
  for (const std::uint64_t tick : {1U, 2U, 4U}) {
    ASSERT_NE(ring_.front(), nullptr);
    EXPECT_EQ(ring_.front()->tick, tick);
    ring_.pop();
  }
}

TEST_F(FrameRingTest, LeavesOutWhatDidNotComeOrIsOfAnotherSize) {
  hal::FrameSet set = frames(0);
  set.frames[0].image.width_px = kWidth - 1;
  ASSERT_TRUE(ring_.try_push(0, {}, set));
  EXPECT_EQ(ring_.front()->delivered.bits(), 0b10);
  ring_.pop();
  set = frames(0);
  set.delivered.erase(1);
  ASSERT_TRUE(ring_.try_push(1, {}, set));
  EXPECT_EQ(ring_.front()->delivered.bits(), 0b01);
}

TEST_F(FrameRingTest, CopyingLeavesTheHeapAlone) {
  const hal::FrameSet set = frames(0);
  const rtos::AllocationTrap::Scope armed;
  const bool taken = ring_.try_push(0, {}, set);
  EXPECT_EQ(armed.calls().total(), 0U);
  EXPECT_TRUE(taken);
}

}  // namespace
}  // namespace dottrack::telemetry
