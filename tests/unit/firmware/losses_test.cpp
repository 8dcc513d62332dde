#include "app/firmware/losses.h"

#include <gtest/gtest.h>

namespace dottrack::firmware {
namespace {

TEST(Losses, OfACameraAreCountedBetweenTwoLooks) {
  drivers::CameraHealth before;
  before.frames = 100;
  before.gaps = 5;
  drivers::CameraHealth now = before;
  now.frames = 200;
  EXPECT_FALSE(losses("cam5", before, now));
  now.gaps = 8;
  now.errors = 2;
  EXPECT_EQ(losses("cam5", before, now), "camera cam5: 3 frames lost, 2 damaged");
  now.late = 1;
  EXPECT_EQ(losses("cam5", before, now), "camera cam5: 3 frames lost, 1 late, 2 damaged");
}

TEST(Losses, OfTheBusAreCountedBetweenTwoLooks) {
  drivers::SocketCanCounts before;
  drivers::SocketCanCounts now;
  now.sent = 500;
  EXPECT_FALSE(losses(before, now));
  now.error_frames = 12;
  now.bus_offs = 1;
  EXPECT_EQ(losses(before, now), "CAN: 12 error frames, 1 times bus-off");
  before = now;
  now.refused_full = 4;
  EXPECT_EQ(losses(before, now), "CAN: 4 frames without room");
}

}  // namespace
}  // namespace dottrack::firmware
