#include "tests/contract/can_bus_contract.h"

#include <algorithm>

#include "rtos_shim/allocation_trap/allocation_trap.h"

namespace dottrack::test {
namespace {

hal::CanFrame frame_of(std::uint32_t id, std::uint8_t length) {
  hal::CanFrame frame;
  frame.id = id;
  frame.length = length;
  for (std::uint8_t i = 0; i < length; ++i) frame.data[i] = static_cast<std::uint8_t>(0xF0 + 7 * i);
  return frame;
}

void expect_same(const hal::CanFrame& heard, const hal::CanFrame& sent) {
  EXPECT_EQ(heard.id, sent.id);
  EXPECT_EQ(heard.extended, sent.extended);
  EXPECT_EQ(heard.fd, sent.fd);
  EXPECT_EQ(heard.bit_rate_switch, sent.bit_rate_switch);
  ASSERT_EQ(heard.length, sent.length);
  EXPECT_TRUE(std::ranges::equal(heard.payload(), sent.payload()));
}

TEST_P(CanBusContract, ABusInGoodOrderIsActive) {
  EXPECT_EQ(bus_.state(), hal::CanState::active);
}

TEST_P(CanBusContract, WhatIsAcceptedGoesOutAsItIsAndInOrder) {
  std::vector<hal::CanFrame> sent;
  for (std::uint8_t length = 0; length <= 8; ++length) {
    sent.push_back(frame_of(0x100U + length, length));
    ASSERT_EQ(send(sent.back()), hal::SendResult::accepted);
  }
  const std::vector<hal::CanFrame> heard = bench_->heard();
  ASSERT_EQ(heard.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) expect_same(heard[i], sent[i]);
}

TEST_P(CanBusContract, TheSmallestAndLargestIdentifiersKeepTheirKind) {
  std::vector<hal::CanFrame> sent = {frame_of(0, 1), frame_of(0x7FF, 1), frame_of(0, 1),
                                     frame_of(0x1FFFFFFF, 1)};
  sent[2].extended = sent[3].extended = true;
  for (const hal::CanFrame& frame : sent) ASSERT_EQ(send(frame), hal::SendResult::accepted);
  const std::vector<hal::CanFrame> heard = bench_->heard();
  ASSERT_EQ(heard.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) expect_same(heard[i], sent[i]);
}

TEST_P(CanBusContract, OwnFramesDoNotComeBack) {
  ASSERT_EQ(send(frame_of(0x123, 8)), hal::SendResult::accepted);
  hal::CanFrame received;
  EXPECT_FALSE(bus_.receive(received));
}

TEST_P(CanBusContract, SendingAndReceivingLeaveTheHeapAlone) {
  const hal::CanFrame frame = frame_of(0x123, 8);
  hal::CanFrame received;
  const rtos::AllocationTrap::Scope armed;
  const hal::SendResult answer = send(frame);
  bus_.receive(received);
  bus_.state();
  EXPECT_EQ(armed.calls().total(), 0U);
  EXPECT_EQ(answer, hal::SendResult::accepted);
}

}  // namespace
}  // namespace dottrack::test
