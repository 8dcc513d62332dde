#include "drivers/socketcan/frame_conversion.h"

#include <gmock/gmock.h>

#include <cstring>
#include <numeric>

namespace dottrack::drivers {
namespace {

hal::CanFrame frame_of(std::uint32_t id, std::uint8_t length, bool fd = false) {
  hal::CanFrame frame;
  frame.id = id;
  frame.fd = fd;
  frame.length = length;
  std::iota(frame.data.begin(), frame.data.begin() + length, std::uint8_t{0x81});
  return frame;
}

WireFrame wire_of(std::uint32_t can_id, std::uint8_t length, std::size_t size = CAN_MTU) {
  WireFrame wire;
  wire.frame.can_id = can_id;
  wire.frame.len = length;
  wire.size = size;
  return wire;
}

void expect_there_and_back(const hal::CanFrame& frame) {
  const auto wire = to_wire(frame);
  ASSERT_TRUE(wire);
  const auto back = from_wire(*wire);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->id, frame.id);
  EXPECT_EQ(back->extended, frame.extended);
  EXPECT_EQ(back->fd, frame.fd);
  EXPECT_EQ(back->bit_rate_switch, frame.bit_rate_switch);
  EXPECT_EQ(back->length, frame.length);
  EXPECT_EQ(back->data, frame.data);
}

TEST(FrameConversion, AClassicFrameIsACanFrame) {
  const auto wire = to_wire(frame_of(0x123, 3));
  ASSERT_TRUE(wire);
  EXPECT_EQ(wire->size, CAN_MTU);
  can_frame classic;
  std::memcpy(&classic, &wire->frame, sizeof(classic));
  EXPECT_EQ(classic.can_id, 0x123U);
  EXPECT_EQ(classic.len, 3);
  EXPECT_THAT(classic.data, testing::ElementsAre(0x81, 0x82, 0x83, 0, 0, 0, 0, 0));
}

TEST(FrameConversion, AnExtendedIdentifierCarriesItsFlag) {
  hal::CanFrame frame = frame_of(0x12, 0);
  frame.extended = true;
  EXPECT_EQ(to_wire(frame)->frame.can_id, 0x12U | CAN_EFF_FLAG);
}

TEST(FrameConversion, EveryLengthComesBackAsItWent) {
  for (std::uint8_t length = 0; length <= 8; ++length) expect_there_and_back(frame_of(1, length));
  constexpr std::uint8_t kLong[] = {0, 8, 12, 16, 20, 24, 32, 48, 64};
  for (const std::uint8_t length : kLong) {
    hal::CanFrame frame = frame_of(0x1FFFFFFF, length, true);
    frame.extended = true;
    frame.bit_rate_switch = length % 16 == 0;
    expect_there_and_back(frame);
  }
}

TEST(FrameConversion, WhatNoBusCanCarryIsRefused) {
  EXPECT_FALSE(to_wire(frame_of(0x800, 1)));
  EXPECT_FALSE(to_wire(frame_of(1, 9)));
  EXPECT_FALSE(to_wire(frame_of(1, 9, true)));
  EXPECT_FALSE(to_wire(frame_of(1, 63, true)));
  hal::CanFrame too_far = frame_of(0x20000000, 1);
  too_far.extended = true;
  EXPECT_FALSE(to_wire(too_far));
  hal::CanFrame switching = frame_of(1, 1);
  switching.bit_rate_switch = true;
  EXPECT_FALSE(to_wire(switching));
  hal::CanFrame too_long = frame_of(1, 64, true);
  too_long.length = 255;
  EXPECT_FALSE(to_wire(too_long));
}

TEST(FrameConversion, OnlyDataFramesComeIn) {
  EXPECT_TRUE(from_wire(wire_of(0x123, 8)));
  EXPECT_FALSE(from_wire(wire_of(0x123 | CAN_ERR_FLAG, 8)));
  EXPECT_FALSE(from_wire(wire_of(0x123 | CAN_RTR_FLAG, 0)));
  EXPECT_FALSE(from_wire(wire_of(0x123, 9)));
  EXPECT_FALSE(from_wire(wire_of(0x800, 1)));
  EXPECT_FALSE(from_wire(wire_of(0x123, 65, CANFD_MTU)));
  EXPECT_FALSE(from_wire(wire_of(0x123, 1, CAN_MTU - 1)));
}

}  // namespace
}  // namespace dottrack::drivers
