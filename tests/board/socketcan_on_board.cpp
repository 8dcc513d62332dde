// SocketCanBus against the kernel's CAN, on a virtual interface that the test makes itself.

#include <gmock/gmock.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <poll.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "drivers/socketcan/can_port.h"
#include "drivers/socketcan/socket_can_bus.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"
#include "tests/board/vcan_link.h"
#include "tests/contract/can_bus_contract.h"

namespace dottrack::test {
namespace {

using drivers::CanPort;
using drivers::SocketCanBus;
using drivers::WireFrame;
using hal::CanState;
using hal::SendResult;
using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr char kInterface[] = "dottracktest0";
constexpr std::uint32_t kListenId = 0x123;

// Somebody else on the bus who hears everything and may say anything, error frames included.
class OtherNode {
 public:
  OtherNode() : port_(::socket(AF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW)) {
    const int on = 1;
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(kInterface));
    ::setsockopt(port_.descriptor(), SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof(on));
    const auto* generic = reinterpret_cast<const sockaddr*>(&address);
    if (::bind(port_.descriptor(), generic, sizeof(address)) != 0) {
      throw std::runtime_error("cannot bind the other node");
    }
  }

  void say(const WireFrame& wire) const { ASSERT_EQ(port_.write(wire), CanPort::Written::done); }
  void say_id(std::uint32_t id, bool extended = false) const {
    hal::CanFrame frame;
    frame.id = id;
    frame.extended = extended;
    say(drivers::to_wire(frame).value());
  }
  void say_error(unsigned classes) const {
    WireFrame wire;
    wire.size = CAN_MTU;
    wire.frame.can_id = CAN_ERR_FLAG | classes;
    wire.frame.len = CAN_ERR_DLC;
    say(wire);
  }

  // Until it has been quiet for a while.
  std::vector<hal::CanFrame> heard() const {
    std::vector<hal::CanFrame> frames;
    pollfd wait{.fd = port_.descriptor(), .events = POLLIN, .revents = 0};
    for (WireFrame wire; ::poll(&wait, 1, 50) == 1 && port_.read(wire) == CanPort::Read::frame;) {
      if (const auto frame = drivers::from_wire(wire)) frames.push_back(*frame);
    }
    return frames;
  }

 private:
  CanPort port_;
};

std::unique_ptr<SocketCanBus> open_bus(const rtos::Clock& clock, bool fd) {
  auto opened =
      SocketCanBus::open({.interface = kInterface, .fd = fd, .listen_ids = {kListenId}}, clock);
  if (!opened) throw std::runtime_error(opened.error().message);
  return std::move(*opened);
}

std::string missing() {
  return why_no_vcan(kInterface);
}

class VcanBench final : public CanBench {
 public:
  explicit VcanBench(bool fd) : bus_(open_bus(clock_, fd)) {}

  hal::CanBus& bus() override { return *bus_; }
  Time now() const override { return clock_.now(); }
  std::vector<hal::CanFrame> heard() override { return other_.heard(); }

 private:
  rtos::MonotonicClock clock_;
  VcanLink link_{kInterface};
  OtherNode other_;
  std::unique_ptr<SocketCanBus> bus_;
};

std::vector<CanCase> cases_here() {
  if (!missing().empty()) return {};
  return {{"classic", [] { return std::make_unique<VcanBench>(false); }},
          {"fd", [] { return std::make_unique<VcanBench>(true); }}};
}
INSTANTIATE_TEST_SUITE_P(Vcan, CanBusContract, testing::ValuesIn(cases_here()));

class SocketCanOnBoard : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string what = missing(); !what.empty()) GTEST_SKIP() << what;
    link_.emplace(kInterface);
    ASSERT_EQ(link_->error(), 0);
    other_.emplace();
    bus_ = open_bus(clock_, true);
  }

  SendResult send() {
    hal::CanFrame frame;
    frame.id = 0x300;
    return bus_->send(frame, clock_.now() + milliseconds(5));
  }
  template <class Condition>
  bool soon(Condition condition) {
    const Time end = clock_.now() + std::chrono::seconds(5);
    while (!condition()) {
      if (clock_.now() > end) return false;
      drivers::pause_for(milliseconds(5));
    }
    return true;
  }
  bool soon_is(CanState state) {
    return soon([&] { return bus_->state() == state; });
  }
  // The identifiers received until that one.
  std::vector<std::uint32_t> received_until(std::uint32_t last) {
    std::vector<std::uint32_t> ids;
    hal::CanFrame frame;
    soon([&] {
      while (bus_->receive(frame)) ids.push_back(frame.id);
      return !ids.empty() && ids.back() == last;
    });
    return ids;
  }

  rtos::MonotonicClock clock_;
  std::optional<VcanLink> link_;
  std::optional<OtherNode> other_;
  std::unique_ptr<SocketCanBus> bus_;
};

TEST_F(SocketCanOnBoard, OnlyWhatItListensToIsReceived) {
  other_->say_id(0x122);
  other_->say_id(kListenId, true);
  other_->say_id(kListenId);
  EXPECT_THAT(received_until(kListenId), testing::ElementsAre(kListenId));
}

TEST_F(SocketCanOnBoard, LongFramesGoOut) {
  hal::CanFrame frame;
  frame.id = 0x1ABCDEF0;
  frame.extended = frame.fd = frame.bit_rate_switch = true;
  frame.length = 64;
  frame.data.fill(0x5A);
  ASSERT_EQ(bus_->send(frame, clock_.now() + milliseconds(5)), SendResult::accepted);
  const std::vector<hal::CanFrame> heard = other_->heard();
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].id, frame.id);
  EXPECT_EQ(heard[0].data, frame.data);
  EXPECT_TRUE(heard[0].bit_rate_switch);
}

TEST_F(SocketCanOnBoard, BusOffIsSeenAndRecoveredFrom) {
  other_->say_error(CAN_ERR_BUSOFF);
  EXPECT_TRUE(soon_is(CanState::bus_off));
  EXPECT_EQ(send(), SendResult::failed);
  other_->say_error(CAN_ERR_RESTARTED);
  EXPECT_TRUE(soon_is(CanState::active));
  EXPECT_EQ(send(), SendResult::accepted);
  EXPECT_EQ(bus_->counts().bus_offs, 1U);
  EXPECT_EQ(bus_->counts().recoveries, 1U);
}

TEST_F(SocketCanOnBoard, DownAndUpIsSurvived) {
  ASSERT_EQ(link_->set_up(false), 0);
  EXPECT_EQ(send(), SendResult::failed);
  EXPECT_EQ(bus_->state(), CanState::absent);
  ASSERT_EQ(link_->set_up(true), 0);
  EXPECT_TRUE(soon_is(CanState::active));
  EXPECT_EQ(send(), SendResult::accepted);
  EXPECT_EQ(bus_->counts().recoveries, 1U);
}

TEST_F(SocketCanOnBoard, DownAndUpBetweenTwoFramesCostsNoFrame) {
  ASSERT_EQ(send(), SendResult::accepted);
  ASSERT_EQ(link_->set_up(false), 0);
  ASSERT_EQ(link_->set_up(true), 0);
  EXPECT_EQ(send(), SendResult::accepted);
  EXPECT_EQ(bus_->counts().recoveries, 1U);
}

TEST_F(SocketCanOnBoard, UnpluggedAndPluggedInAgainIsFoundAgain) {
  ASSERT_EQ(link_->remove(), 0);
  EXPECT_EQ(send(), SendResult::failed);
  EXPECT_EQ(bus_->state(), CanState::absent);
  ASSERT_EQ(link_->make(), 0);
  EXPECT_TRUE(soon_is(CanState::active));
  other_.emplace();
  EXPECT_EQ(send(), SendResult::accepted);
  EXPECT_EQ(other_->heard().size(), 1U);
  other_->say_id(0x122);
  other_->say_id(kListenId);
  EXPECT_THAT(received_until(kListenId), testing::ElementsAre(kListenId));
  other_->say_error(CAN_ERR_BUSOFF);
  EXPECT_TRUE(soon_is(CanState::bus_off));
}

TEST_F(SocketCanOnBoard, AnInterfaceThatIsDownCanBeOpened) {
  ASSERT_EQ(link_->set_up(false), 0);
  bus_ = open_bus(clock_, true);
  EXPECT_EQ(bus_->state(), CanState::absent);
  ASSERT_EQ(link_->set_up(true), 0);
  EXPECT_TRUE(soon_is(CanState::active));
  EXPECT_EQ(bus_->counts().recoveries, 0U);
}

TEST_F(SocketCanOnBoard, WhatCannotBeOpenedIsSaid) {
  const auto not_can = SocketCanBus::open({.interface = "lo"}, clock_);
  ASSERT_FALSE(not_can);
  EXPECT_THAT(not_can.error().message, HasSubstr("lo: is no CAN interface"));
  const auto none = SocketCanBus::open({.interface = "nosuchcan0"}, clock_);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("no such network interface"));
  bus_.reset();
  link_.reset();
  const VcanLink classic(kInterface, CAN_MTU);
  const auto fd = SocketCanBus::open({.interface = kInterface, .fd = true}, clock_);
  ASSERT_FALSE(fd);
  EXPECT_THAT(fd.error().message, HasSubstr("expected FD"));
  EXPECT_TRUE(SocketCanBus::open({.interface = kInterface}, clock_));
}

TEST_F(SocketCanOnBoard, TheInterfaceIsListed) {
  const auto listed = drivers::list_can_interfaces();
  ASSERT_TRUE(listed);
  const auto found = std::ranges::find(*listed, kInterface, &drivers::CanInterface::name);
  ASSERT_NE(found, listed->end());
  EXPECT_TRUE(found->up);
  EXPECT_TRUE(found->fd);
  EXPECT_EQ(found->bit_rate, 0U);
}

}  // namespace
}  // namespace dottrack::test
