// The load of the messages' rates, reckoned by hand.

#include <gtest/gtest.h>

#include <chrono>

#include "app/core/protocol/bus_load.h"

namespace dottrack::protocol {
namespace {

using std::chrono::milliseconds;

constexpr double kFrame_bits = 135.0;
constexpr double kExtendedFrame_bits = 160.0;

constexpr double kNanosecond_us = 0.0011;  // the durations are rounded up to one

double microseconds(Duration duration) {
  return std::chrono::duration<double, std::micro>(duration).count();
}

TEST(BusLoad, OfTheDefaultRates) {
  const BusLoad load = bus_load({}, {}, {}, 8, milliseconds(100));
  const double frames = 6 + 5 + 2 + 1 / 10.0 + 2 * 8 / 10.0 + 2 / 30.0;
  EXPECT_DOUBLE_EQ(load.average, frames * kFrame_bits * 10.0 / 500e3);
  EXPECT_EQ(load.fullest_frames, 6U + 5U + 2U + 1U + 16U + 2U);
  EXPECT_NEAR(microseconds(load.fullest_group), 32 * kFrame_bits / 0.5, kNanosecond_us);
}

TEST(BusLoad, OfLongIdentifiersAtAnotherRate) {
  const Addressing extended{.base_id = 0x18FF0000, .extended = true};
  const BusLoad load = bus_load(extended, {}, {.arbitration = 125'000}, 3, milliseconds(200));
  const double frames = 6 + 5 + 2 + 1 / 10.0 + 2 * 3 / 10.0 + 2 / 30.0;
  EXPECT_DOUBLE_EQ(load.average, frames * kExtendedFrame_bits * 5.0 / 125e3);
  EXPECT_NEAR(microseconds(load.fullest_group), 22 * kExtendedFrame_bits / 0.125, kNanosecond_us);
}

TEST(BusLoad, InFdThePoseAndItsCovarianceAreOneFrame) {
  const Addressing fd{.fd = true};
  const BusLoad load = bus_load(fd, {}, {}, 4, milliseconds(100));
  const double others = 2 + 1 / 10.0 + 2 * 4 / 10.0 + 2 / 30.0;
  const double group_us = 409.5 + others * kFrame_bits / 0.5;
  EXPECT_NEAR(load.average, group_us / 100e3, 1e-12);
  EXPECT_EQ(load.fullest_frames, 1U + 2U + 1U + 8U + 2U);
  EXPECT_NEAR(microseconds(load.fullest_group), 409.5 + 13 * kFrame_bits / 0.5, kNanosecond_us);
}

// However many cameras there are: one after another.
TEST(BusLoad, LightIsOneFrameMore) {
  const Rates rates{.light_every = 2};
  const BusLoad load = bus_load({}, rates, {}, 8, milliseconds(100));
  const BusLoad without = bus_load({}, {}, {}, 8, milliseconds(100));
  EXPECT_NEAR(load.average - without.average, kFrame_bits / 2.0 * 10.0 / 500e3, 1e-12);
  EXPECT_EQ(load.fullest_frames, without.fullest_frames + 1);
  EXPECT_NEAR(microseconds(load.fullest_group - without.fullest_group), kFrame_bits / 0.5,
              kNanosecond_us);
}

TEST(BusLoad, OfWhatNeverGoesOutIsNothing) {
  const Rates pose_alone{.pose_every = 4,
                         .covariance_every = 0,
                         .motion_every = 0,
                         .cameras_every = 0,
                         .dots_every = 0,
                         .identity_every = 0,
                         .light_every = 0};
  const BusLoad load = bus_load({}, pose_alone, {}, 16, milliseconds(10));
  EXPECT_DOUBLE_EQ(load.average, 6 * kFrame_bits / 500e3 / 0.040);
  EXPECT_EQ(load.fullest_frames, 6U);
}

}  // namespace
}  // namespace dottrack::protocol
