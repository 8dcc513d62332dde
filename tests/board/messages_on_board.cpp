// The unit's messages and a vehicle's commands through the kernel's CAN.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "app/cycle/broadcaster.h"
#include "drivers/socketcan/socket_can_bus.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"
#include "tests/board/vcan_link.h"
#include "tests/support/bus_listener.h"

namespace dottrack::test {
namespace {

using drivers::SocketCanBus;
using std::chrono::milliseconds;

constexpr char kInterface[] = "dottracktest1";
constexpr unsigned kGroups = 20;

class MessagesOnBoard : public testing::TestWithParam<protocol::Addressing> {
 protected:
  void SetUp() override {
    if (const std::string why = why_no_vcan(kInterface); !why.empty()) GTEST_SKIP() << why;
    link_ = std::make_unique<VcanLink>(kInterface);
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < protocol::kIdentifiers; ++i)
      all.push_back(GetParam().base_id + i);
    unit_ = open({protocol::command_id(GetParam())});
    vehicle_ = open(all);
    protocol::BroadcastSettings settings;
    settings.addressing = GetParam();
    settings.commands = true;
    broadcaster_ = std::make_unique<cycle::Broadcaster>(*unit_, settings);
  }

  std::unique_ptr<SocketCanBus> open(std::vector<std::uint32_t> ids) {
    auto bus = SocketCanBus::open({.interface = kInterface,
                                   .fd = GetParam().fd,
                                   .listen_ids = std::move(ids),
                                   .listen_extended = GetParam().extended},
                                  clock_);
    if (!bus) throw std::runtime_error(bus.error().message);
    return std::move(*bus);
  }

  Time soon() const { return clock_.now() + milliseconds(500); }

  // The kernel hands frames on in its own time: asks again until there is an answer, or for long.
  template <class Ask>
  static auto patiently(const Ask& ask) {
    auto answer = ask();
    for (int tries = 0; !answer && tries < 2000; ++tries) {
      std::this_thread::sleep_for(milliseconds(1));
      answer = ask();
    }
    return answer;
  }

  std::vector<hal::CanFrame> heard_by_vehicle() {
    std::vector<hal::CanFrame> frames;
    for (hal::CanFrame frame; vehicle_->receive(frame);) frames.push_back(frame);
    return frames;
  }

  rtos::MonotonicClock clock_;
  std::unique_ptr<VcanLink> link_;
  std::unique_ptr<SocketCanBus> unit_;
  std::unique_ptr<SocketCanBus> vehicle_;
  std::unique_ptr<cycle::Broadcaster> broadcaster_;
  telemetry::CycleCounters counters_;
};

TEST_P(MessagesOnBoard, EveryGroupArrivesWholeAndSound) {
  BusListener listener(GetParam());
  protocol::PoseMessage message;
  message.state = core::State::tracking;
  message.pose_valid = true;
  message.dots_known = 5;
  message.covariance = Eigen::Matrix<double, 6, 6>::Identity() * 1e-6;
  for (unsigned i = 0; i < kGroups; ++i) {
    message.mid_exposure = Time(milliseconds(1000 + 33 * i));
    message.position_m.x() = 0.1 * i;
    ASSERT_TRUE(broadcaster_->tell(message, soon(), counters_));
    ASSERT_TRUE(patiently([&] {
      for (const hal::CanFrame& frame : heard_by_vehicle()) listener.hear(frame);
      return listener.poses().size() == i + 1;
    })) << "group "
        << i;
  }
  EXPECT_NEAR(listener.poses().back().position_m[0], 0.1 * (kGroups - 1), 1e-4);
  EXPECT_TRUE(listener.poses().back().has_covariance);
  EXPECT_EQ(listener.counts().corrupted + listener.counts().incomplete, 0U);
  EXPECT_TRUE(listener.unit().has_version);
}

TEST_P(MessagesOnBoard, ACommandIsHeardAndAnswered) {
  dottrack_settings settings = dottrack_default_settings();
  settings.base_id = GetParam().base_id;
  settings.extended = GetParam().extended;
  const dottrack_frame command =
      dottrack_command_frame(&settings, DOTTRACK_COMMAND_ACQUIRE, 0, 0x1234, 9);
  ASSERT_EQ(vehicle_->send(protocol::from_receiver(command), soon()), hal::SendResult::accepted);
  const auto heard = patiently([&] { return broadcaster_->listen(clock_.now(), soon()); });
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->code, protocol::CommandCode::acquire);
  broadcaster_->reply(true, soon());
  dottrack_reply reply{};
  ASSERT_TRUE(patiently([&] {
    const std::vector<hal::CanFrame> answers = heard_by_vehicle();
    return std::ranges::any_of(answers, [&](const hal::CanFrame& frame) {
      const dottrack_frame answer = protocol::to_receiver(frame);
      return dottrack_read_reply(&settings, &answer, &reply);
    });
  }));
  EXPECT_EQ(reply.token, 0x1234);
  EXPECT_STREQ(dottrack_result_text(reply.result), "done");
}

INSTANTIATE_TEST_SUITE_P(Addressings, MessagesOnBoard,
                         testing::Values(protocol::Addressing{.base_id = 0x300},
                                         protocol::Addressing{.base_id = 0x300, .extended = true},
                                         protocol::Addressing{
                                             .base_id = 0x18DA00, .extended = true, .fd = true}),
                         [](const testing::TestParamInfo<protocol::Addressing>& of) {
                           const std::string bits = of.param.extended ? "Bits29" : "Bits11";
                           return bits + (of.param.fd ? "Fd" : "") + std::to_string(of.index);
                         });

}  // namespace
}  // namespace dottrack::test
