#include "host_sim/hal/sim_can_bus.h"

#include <gtest/gtest.h>

#include <memory>

#include "app/core/protocol/pose_encoder.h"
#include "tests/support/listening_can_bus.h"

namespace dottrack::host_sim {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class SimCan : public testing::Test {
 protected:
  void make(const CanModel& model) {
    model_ = model;
    bus_ = std::make_unique<SimCanBus>(model, 3, clock_, log_);
  }
  hal::SendResult send(std::uint32_t id = 0x123, Duration patience = Duration(0)) {
    hal::CanFrame frame;
    frame.id = id;
    frame.length = 8;
    return bus_->send(frame, clock_.now() + patience);
  }
  void broadcast(std::uint8_t sequence, double x_m) {
    protocol::PoseMessage message;
    message.state = core::State::tracking;
    message.pose_valid = true;
    message.position_m.x() = x_m;
    message.mid_exposure = clock_.now();
    protocol::GroupFrames frames;
    protocol::encode_group(message, {}, model_.addressing, sequence, frames);
    for (const hal::CanFrame& frame : frames) bus_->send(frame, clock_.now() + milliseconds(10));
  }
  void wait(Duration time) { clock_.jump_to(clock_.now() + time); }

  CanModel model_;
  rtos::VirtualClock clock_;
  test::ListeningCanBus log_;
  std::unique_ptr<SimCanBus> bus_;
};

TEST_F(SimCan, AFrameOfEightBytesTakes135Bits) {
  hal::CanFrame frame;
  frame.length = 8;
  EXPECT_EQ(SimCanBus::bits(frame).arbitration, 135.0);
  frame.extended = true;
  EXPECT_EQ(SimCanBus::bits(frame).arbitration, 160.0);
  EXPECT_EQ(SimCanBus::bits(frame).data, 0.0);
}

// 17 bits to the switch of the rate, 4 stuff bits among them, 13 at the end; 5 bits of control, 512
// of data, 129 stuff bits, 4 of stuff count, 21 of checksum, 7 fixed stuff bits.
TEST_F(SimCan, AnFdFrameOf64BytesHasMostOfItsBitsAtTheFastRate) {
  hal::CanFrame frame;
  frame.fd = true;
  frame.bit_rate_switch = true;
  frame.length = 64;
  EXPECT_EQ(SimCanBus::bits(frame).arbitration, 34.0);
  EXPECT_EQ(SimCanBus::bits(frame).data, 678.0);
  frame.bit_rate_switch = false;
  EXPECT_EQ(SimCanBus::bits(frame).arbitration, 712.0);
}

TEST_F(SimCan, FramesGoOutOneAfterAnotherAtTheBitRate) {
  make({.bit_rate = 135000.0});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(send(), hal::SendResult::accepted);
  EXPECT_EQ(log_.take().size(), 3U) << "a log has them when they are accepted";
  EXPECT_EQ(bus_->counts().sent, 0U);
  wait(milliseconds(2));
  EXPECT_EQ(bus_->counts().sent, 2U);
  wait(milliseconds(1));
  EXPECT_EQ(bus_->counts().sent, 3U);
}

TEST_F(SimCan, OthersOnTheBusMakeFramesSlower) {
  make({.bit_rate = 135000.0, .load = 0.5});
  send();
  wait(milliseconds(1));
  EXPECT_EQ(bus_->counts().sent, 0U);
  wait(milliseconds(1));
  EXPECT_EQ(bus_->counts().sent, 1U);
}

TEST_F(SimCan, AFullQueueIsWaitedForAndNoLongerThanTheDeadline) {
  make({.bit_rate = 135000.0});
  for (std::size_t i = 0; i < SimCanBus::kQueue; ++i) {
    ASSERT_EQ(send(), hal::SendResult::accepted);
  }
  EXPECT_EQ(clock_.now(), Time{});
  EXPECT_EQ(send(0x123, std::chrono::microseconds(500)), hal::SendResult::try_again);
  EXPECT_EQ(clock_.now(), Time(std::chrono::microseconds(500)));
  EXPECT_EQ(send(0x123, milliseconds(5)), hal::SendResult::accepted);
  EXPECT_EQ(clock_.now(), Time(milliseconds(1)));
  EXPECT_EQ(bus_->counts().refused_full, 1U);
}

TEST_F(SimCan, FreshGroupsAreCountedAndTheLastIsKept) {
  make({});
  broadcast(1, 4.0);
  EXPECT_EQ(bus_->counts().groups, 0U) << "none has gone out yet";
  wait(milliseconds(2));
  EXPECT_EQ(bus_->counts().groups, 1U);
  broadcast(2, 5.0);
  wait(milliseconds(2));
  EXPECT_EQ(bus_->counts().groups, 2U);
  ASSERT_TRUE(bus_->last_pose());
  EXPECT_NEAR(bus_->last_pose()->position_m[0], 5.0, 1e-3);
}

TEST_F(SimCan, AnFdPoseUnderAnotherIdentifierIsHeardToo) {
  make({.addressing = {.base_id = 0x18DA00, .extended = true, .fd = true}});
  broadcast(1, 4.0);
  wait(milliseconds(2));
  EXPECT_EQ(bus_->counts().sent, 1U);
  EXPECT_EQ(bus_->counts().groups, 1U);
}

TEST_F(SimCan, AnOutageRefusesFramesLosesTheQueueAndEnds) {
  make({.bit_rate = 135000.0, .bus_off = {{0.0015, 0.1}}});
  for (int i = 0; i < 4; ++i) send();
  wait(milliseconds(50));
  EXPECT_EQ(bus_->state(), hal::CanState::bus_off);
  EXPECT_EQ(send(), hal::SendResult::failed);
  EXPECT_EQ(bus_->counts().sent, 1U);
  EXPECT_EQ(bus_->counts().lost, 3U);
  wait(milliseconds(55));
  EXPECT_EQ(bus_->state(), hal::CanState::bus_off) << "128 x 11 bits of recovery";
  wait(milliseconds(6));
  EXPECT_EQ(bus_->state(), hal::CanState::active);
  EXPECT_EQ(send(), hal::SendResult::accepted);
  EXPECT_EQ(bus_->counts().refused_off, 1U);
}

TEST_F(SimCan, DestroyedFramesAreSentAgain) {
  make({.error_share = 0.05});
  for (int i = 0; i < 2000; ++i) {
    ASSERT_EQ(send(), hal::SendResult::accepted);
    wait(milliseconds(2));
  }
  EXPECT_EQ(bus_->counts().sent, 2000U);
  EXPECT_NEAR(static_cast<double>(bus_->counts().destroyed), 105.0, 35.0);
}

TEST_F(SimCan, TooManyErrorsTakeTheBusOffAndItComesBack) {
  make({.error_share = 0.6});
  bool off = false;
  bool passive = false;
  bool back = false;
  for (int i = 0; i < 400; ++i) {
    send();
    back = back || (off && bus_->state() == hal::CanState::active);
    passive = passive || bus_->state() == hal::CanState::passive;
    off = off || bus_->state() == hal::CanState::bus_off;
    wait(milliseconds(1));
  }
  EXPECT_TRUE(passive);
  EXPECT_TRUE(off);
  EXPECT_TRUE(back);
  EXPECT_GT(bus_->counts().bus_offs, 0U);
}

TEST_F(SimCan, WhatOthersSayIsReceivedInOrder) {
  make({});
  hal::CanFrame frame;
  EXPECT_FALSE(bus_->receive(frame));
  for (std::uint32_t id = 1; id <= 64; ++id) {
    frame.id = id;
    EXPECT_TRUE(bus_->inject(frame));
  }
  EXPECT_FALSE(bus_->inject(frame));
  for (std::uint32_t id = 1; id <= 64; ++id) {
    ASSERT_TRUE(bus_->receive(frame));
    EXPECT_EQ(frame.id, id);
  }
  EXPECT_FALSE(bus_->receive(frame));
}

}  // namespace
}  // namespace dottrack::host_sim
