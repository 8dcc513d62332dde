#include "drivers/socketcan/error_frame.h"

#include <gtest/gtest.h>
#include <linux/can/error.h>

namespace dottrack::drivers {
namespace {

WireFrame error_frame(std::uint32_t classes) {
  WireFrame wire;
  wire.frame.can_id = CAN_ERR_FLAG | classes;
  wire.frame.len = CAN_ERR_DLC;
  wire.size = CAN_MTU;
  return wire;
}

ErrorReport controller_says(std::uint8_t bits) {
  WireFrame wire = error_frame(CAN_ERR_CRTL);
  wire.frame.data[1] = bits;
  return read_error_frame(wire).value();
}

ErrorReport counters_say(std::uint8_t sending, std::uint8_t receiving) {
  WireFrame wire = error_frame(CAN_ERR_CNT);
  wire.frame.data[6] = sending;
  wire.frame.data[7] = receiving;
  return read_error_frame(wire).value();
}

TEST(ErrorFrame, ADataFrameIsNone) {
  WireFrame wire = error_frame(CAN_ERR_BUSOFF);
  wire.frame.can_id &= ~CAN_ERR_FLAG;
  EXPECT_FALSE(read_error_frame(wire));
}

TEST(ErrorFrame, BusOffAndRestartAreTold) {
  EXPECT_TRUE(read_error_frame(error_frame(CAN_ERR_BUSOFF))->bus_off);
  EXPECT_FALSE(read_error_frame(error_frame(CAN_ERR_BUSOFF))->restarted);
  EXPECT_TRUE(read_error_frame(error_frame(CAN_ERR_RESTARTED))->restarted);
  EXPECT_FALSE(read_error_frame(error_frame(CAN_ERR_RESTARTED))->bus_off);
}

TEST(ErrorFrame, TheWorseDirectionIsTheControllersFault) {
  EXPECT_EQ(controller_says(CAN_ERR_CRTL_ACTIVE).fault, hal::CanState::active);
  EXPECT_EQ(controller_says(CAN_ERR_CRTL_RX_WARNING).fault, hal::CanState::warning);
  EXPECT_EQ(controller_says(CAN_ERR_CRTL_TX_WARNING).fault, hal::CanState::warning);
  EXPECT_EQ(controller_says(CAN_ERR_CRTL_RX_PASSIVE).fault, hal::CanState::passive);
  EXPECT_EQ(controller_says(CAN_ERR_CRTL_TX_PASSIVE | CAN_ERR_CRTL_RX_WARNING).fault,
            hal::CanState::passive);
}

TEST(ErrorFrame, AnOverflowIsNoStateOfTheController) {
  EXPECT_FALSE(controller_says(CAN_ERR_CRTL_RX_OVERFLOW).fault);
}

TEST(ErrorFrame, TheControllerByteCountsOnlyWhereItIsMeant) {
  WireFrame wire = error_frame(CAN_ERR_PROT);
  wire.frame.data[1] = CAN_ERR_CRTL_TX_PASSIVE;
  EXPECT_FALSE(read_error_frame(wire)->fault);
}

TEST(ErrorFrame, CountersGiveTheStateByTheirThresholds) {
  EXPECT_EQ(counters_say(0, 95).counts, hal::CanState::active);
  EXPECT_EQ(counters_say(96, 0).counts, hal::CanState::warning);
  EXPECT_EQ(counters_say(0, 127).counts, hal::CanState::warning);
  EXPECT_EQ(counters_say(128, 3).counts, hal::CanState::passive);
  EXPECT_FALSE(read_error_frame(error_frame(CAN_ERR_ACK))->counts);
}

}  // namespace
}  // namespace dottrack::drivers
