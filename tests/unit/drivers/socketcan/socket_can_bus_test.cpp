#include "drivers/socketcan/socket_can_bus.h"

#include <gmock/gmock.h>

#include "drivers/socketcan/socket_can_link.h"
#include "rtos_shim/allocation_trap/allocation_trap.h"
#include "rtos_shim/virtual_time/virtual_clock.h"
#include "tests/support/can_pair.h"

namespace dottrack::drivers {
namespace {

using hal::CanState;
using hal::SendResult;
using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

// Every look at it takes a tenth of a millisecond.
class TickingClock final : public rtos::Clock {
 private:
  Time do_now() const override { return now_ += std::chrono::microseconds(100); }
  mutable Time now_{};
};

hal::CanFrame frame_of(std::uint32_t id) {
  hal::CanFrame frame;
  frame.id = id;
  frame.length = 8;
  return frame;
}

class SocketCanBusTest : public testing::Test {
 protected:
  SendResult send() { return bus_.send(frame_of(0x300), clock_.now() + milliseconds(2)); }
  void pass(Duration time) { clock_.jump_to(clock_.now() + time); }
  void fill() {
    for (int tries = 0; tries < 10000; ++tries) {
      if (send() != SendResult::accepted) return;
    }
    FAIL() << "takes frames without end";
  }

  rtos::VirtualClock clock_{Time(milliseconds(5000))};
  test::CanPair pair_;
  SocketCanBus bus_{pair_.channel(false, clock_)};
};

TEST_F(SocketCanBusTest, FullUntilTheDeadlineIsTryAgainAndNothingIsSentLater) {
  fill();
  const std::uint64_t sent = bus_.counts().sent;
  EXPECT_EQ(send(), SendResult::try_again) << "even where the clock stands still";
  EXPECT_EQ(bus_.counts().refused_full, 2U);
  EXPECT_THAT(pair_.heard(), SizeIs(sent));
  EXPECT_EQ(send(), SendResult::accepted);
  EXPECT_EQ(bus_.state(), CanState::active);
}

TEST_F(SocketCanBusTest, ADeadlineThatHasPassedStillGetsOneTry) {
  EXPECT_EQ(bus_.send(frame_of(1), clock_.now() - milliseconds(1)), SendResult::accepted);
  fill();
  EXPECT_EQ(bus_.send(frame_of(1), clock_.now() - milliseconds(1)), SendResult::try_again);
}

TEST(SocketCanBusDeadline, IsTheGivenClocks) {
  const TickingClock clock;
  test::CanPair pair;
  SocketCanBus bus(pair.channel(false, clock));
  SendResult last = SendResult::accepted;
  Time deadline{};
  while (last == SendResult::accepted) {
    deadline = clock.now() + milliseconds(30);
    last = bus.send(frame_of(1), deadline);
  }
  EXPECT_EQ(last, SendResult::try_again);
  EXPECT_GE(clock.now(), deadline);
  EXPECT_LT(clock.now(), deadline + milliseconds(2));
}

TEST_F(SocketCanBusTest, AFullBusOnTheHeapCostsNothing) {
  fill();
  const rtos::AllocationTrap::Scope armed;
  const SendResult answer = send();
  EXPECT_EQ(armed.calls().total(), 0U);
  EXPECT_EQ(answer, SendResult::try_again);
}

TEST_F(SocketCanBusTest, BusOffFailsUntilTheRestart) {
  ASSERT_TRUE(pair_.bring_error(CAN_ERR_BUSOFF));
  EXPECT_EQ(send(), SendResult::failed);
  EXPECT_EQ(bus_.state(), CanState::bus_off);
  EXPECT_THAT(pair_.heard(), SizeIs(0)) << "the kernel would take it and drop it";
  ASSERT_TRUE(pair_.bring_error(CAN_ERR_RESTARTED));
  EXPECT_EQ(send(), SendResult::accepted);
  EXPECT_EQ(bus_.state(), CanState::active);
  const SocketCanCounts counts = bus_.counts();
  EXPECT_EQ(counts.error_frames, 2U);
  EXPECT_EQ(counts.bus_offs, 1U);
  EXPECT_EQ(counts.recoveries, 1U);
  EXPECT_EQ(counts.failed, 1U);
  EXPECT_EQ(counts.sent, 1U);
}

TEST_F(SocketCanBusTest, BusOffWhileWaitingEndsTheWait) {
  fill();
  ASSERT_TRUE(pair_.bring_error(CAN_ERR_BUSOFF));
  EXPECT_EQ(bus_.send(frame_of(1), clock_.now() + std::chrono::hours(1)), SendResult::failed);
}

TEST_F(SocketCanBusTest, StateFollowsErrorFramesWithNothingSent) {
  ASSERT_TRUE(pair_.bring_error(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING));
  EXPECT_EQ(bus_.state(), CanState::warning);
  ASSERT_TRUE(pair_.bring_error(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE));
  EXPECT_EQ(bus_.state(), CanState::passive);
  EXPECT_EQ(send(), SendResult::accepted);
  ASSERT_TRUE(pair_.bring_error(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE));
  EXPECT_EQ(bus_.state(), CanState::active);
}

TEST_F(SocketCanBusTest, ALinkThatGoesDownIsAbsentUntilItComesUp) {
  pair_.link.state = LinkState::down;
  pass(milliseconds(50));
  EXPECT_EQ(bus_.state(), CanState::absent);
  EXPECT_EQ(send(), SendResult::failed);
  pair_.link.state = LinkState::running;
  pass(milliseconds(50));
  EXPECT_EQ(send(), SendResult::accepted);
  EXPECT_EQ(bus_.counts().recoveries, 1U);
}

TEST_F(SocketCanBusTest, TheLinkIsNotLookedAtWithEveryCall) {
  const int looks = pair_.link.looks;
  for (int i = 0; i < 5; ++i) bus_.state();
  EXPECT_LE(pair_.link.looks, looks + 1);
}

TEST_F(SocketCanBusTest, ALinkThatIsGoneIsBoundAgainInItsOwnTime) {
  pair_.link.state = LinkState::gone;
  pass(milliseconds(50));
  EXPECT_EQ(bus_.state(), CanState::absent);
  for (int i = 0; i < 50; ++i) {
    pass(milliseconds(10));
    EXPECT_EQ(send(), SendResult::failed);
  }
  EXPECT_GE(pair_.link.binds, 2);
  EXPECT_LE(pair_.link.binds, 5) << "no more often than every 100 ms";
  pair_.link.state = LinkState::running;
  pass(milliseconds(100));
  EXPECT_EQ(send(), SendResult::accepted);
  EXPECT_EQ(bus_.counts().recoveries, 1U);
}

TEST_F(SocketCanBusTest, AClosedPeerIsGone) {
  pair_.link.state = LinkState::gone;
  pair_.close_bus_end();
  EXPECT_EQ(send(), SendResult::failed);
  EXPECT_EQ(bus_.state(), CanState::absent);
}

TEST_F(SocketCanBusTest, DataFramesAmongErrorFramesKeepTheirOrder) {
  ASSERT_TRUE(pair_.bring(frame_of(0x10)));
  ASSERT_TRUE(pair_.bring_error(CAN_ERR_ACK));
  ASSERT_TRUE(pair_.bring(frame_of(0x11)));
  EXPECT_EQ(send(), SendResult::accepted);
  hal::CanFrame frame;
  ASSERT_TRUE(bus_.receive(frame));
  EXPECT_EQ(frame.id, 0x10U);
  ASSERT_TRUE(bus_.receive(frame));
  EXPECT_EQ(frame.id, 0x11U);
  EXPECT_FALSE(bus_.receive(frame));
}

TEST_F(SocketCanBusTest, TheNewestFramesAreKeptWhenNobodyReceives) {
  constexpr std::uint32_t kBrought = FrameInbox::kCapacity + 3;
  for (std::uint32_t id = 0; id < kBrought; ++id) {
    ASSERT_TRUE(pair_.bring(frame_of(id)));
    bus_.state();
  }
  hal::CanFrame frame;
  for (std::uint32_t id = 3; id < kBrought; ++id) {
    ASSERT_TRUE(bus_.receive(frame));
    EXPECT_EQ(frame.id, id);
  }
  EXPECT_FALSE(bus_.receive(frame));
  EXPECT_EQ(bus_.counts().overwritten, 3U);
}

TEST_F(SocketCanBusTest, ABurstLongerThanTheInboxIsReceivedWhole) {
  constexpr std::uint32_t kBrought = 2 * FrameInbox::kCapacity + 5;
  for (std::uint32_t id = 0; id < kBrought; ++id) ASSERT_TRUE(pair_.bring(frame_of(id)));
  hal::CanFrame frame;
  for (std::uint32_t id = 0; id < kBrought; ++id) {
    ASSERT_TRUE(bus_.receive(frame)) << id;
    EXPECT_EQ(frame.id, id);
  }
  EXPECT_FALSE(bus_.receive(frame));
  EXPECT_EQ(bus_.counts().overwritten, 0U);
}

TEST(SocketCanFilters, SayWhichIdentifiersHave29Bits) {
  constexpr std::uint32_t kIds[] = {0x300, 0x12345};
  const auto by_size = filters_for(kIds);
  ASSERT_EQ(by_size.size(), 2U);
  EXPECT_EQ(by_size[0].can_id, 0x300U);
  EXPECT_EQ(by_size[1].can_id, 0x12345U | CAN_EFF_FLAG);
  const auto extended = filters_for(kIds, true);
  ASSERT_EQ(extended.size(), 2U);
  EXPECT_EQ(extended[0].can_id, 0x300U | CAN_EFF_FLAG);
  EXPECT_EQ(extended[0].can_mask, CAN_EFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG);
}

TEST_F(SocketCanBusTest, ARemoteRequestIsNobodysFrame) {
  WireFrame request = to_wire(frame_of(0x10)).value();
  request.frame.can_id |= CAN_RTR_FLAG;
  ASSERT_TRUE(pair_.bring(request));
  hal::CanFrame frame;
  EXPECT_FALSE(bus_.receive(frame));
}

TEST_F(SocketCanBusTest, AClassicBusRefusesFdFrames) {
  hal::CanFrame frame = frame_of(1);
  frame.fd = true;
  EXPECT_EQ(bus_.send(frame, clock_.now()), SendResult::failed);
  EXPECT_THAT(pair_.heard(), SizeIs(0));
}

TEST(SocketCanBusFd, LongFramesGoBothWays) {
  const rtos::VirtualClock clock;
  test::CanPair pair;
  SocketCanBus bus(pair.channel(true, clock));
  hal::CanFrame frame = frame_of(0x301);
  frame.fd = frame.bit_rate_switch = true;
  frame.length = 64;
  frame.data[63] = 0xA5;
  ASSERT_EQ(bus.send(frame, clock.now()), SendResult::accepted);
  const std::vector<hal::CanFrame> heard = pair.heard();
  ASSERT_THAT(heard, SizeIs(1));
  EXPECT_EQ(heard[0].data, frame.data);
  EXPECT_TRUE(heard[0].bit_rate_switch);
  hal::CanFrame received;
  ASSERT_TRUE(pair.bring(frame));
  ASSERT_TRUE(bus.receive(received));
  EXPECT_EQ(received.length, 64);
  EXPECT_EQ(received.data, frame.data);
}

TEST(SocketCanBusOpen, AnErrorNamesTheInterface) {
  const rtos::VirtualClock clock;
  const auto opened = SocketCanBus::open({.interface = "nosuchcan0"}, clock);
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, StartsWith("nosuchcan0: "));
}

TEST(SocketCanBusOpen, RefusesAnIdentifierThatDoesNotExist) {
  const rtos::VirtualClock clock;
  const auto opened =
      SocketCanBus::open({.interface = "can7", .fd = false, .listen_ids = {0x20000000}}, clock);
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("29 bits"));
}

}  // namespace
}  // namespace dottrack::drivers
