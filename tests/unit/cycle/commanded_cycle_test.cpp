// The loop that listens to commands over CAN.

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "app/core/protocol/command.h"
#include "app/cycle/requests.h"
#include "tests/unit/cycle/cycle_fixture.h"

namespace dottrack::cycle::test {
namespace {

class CommandedCycleTest : public CycleTest {
 protected:
  CommandedCycleTest() {
    protocol::BroadcastSettings broadcast;
    broadcast.commands = true;
    broadcast.targets = 2;
    commanded_.emplace(CycleParts{.grabber = grabber_,
                                  .iris = iris_,
                                  .can = can_,
                                  .tracker = tracker_,
                                  .clock = clock_,
                                  .stopwatch = stopwatch_,
                                  .records = *ring_,
                                  .requests = &requests_},
                       settings_for(scene_.rig(), kPeriod, broadcast));
  }

  void hear(protocol::CommandCode code, std::uint8_t argument = 0) {
    can_.heard.push_back(
        protocol::encode_command({code, argument, kToken}, {}, command_sequence_++));
  }

  const telemetry::CycleRecord& commanded_tick() {
    commanded_->tick(timer_.wait());
    if (!ring_->try_pop(record_)) throw std::runtime_error("the tick left no record");
    return record_;
  }

  std::vector<dottrack_reply> replies() const {
    std::vector<dottrack_reply> replies;
    const dottrack_settings settings = dottrack_default_settings();
    for (std::size_t i = 0; i < can_.sent_size; ++i) {
      dottrack_reply reply{};
      const dottrack_frame frame = protocol::to_receiver(can_.sent[i]);
      if (dottrack_read_reply(&settings, &frame, &reply)) replies.push_back(reply);
    }
    return replies;
  }

  static constexpr std::uint16_t kToken = 0xBEEF;
  Requests requests_;
  std::optional<Cycle> commanded_;
  std::uint8_t command_sequence_ = 7;
};

TEST_F(CommandedCycleTest, ACommandMakesItLookForTheTargetAnew) {
  show(0);
  commanded_tick();
  hear(protocol::CommandCode::acquire);
  EXPECT_EQ(commanded_tick().result.reset_count, 1U);
  EXPECT_EQ(record_.counters.commands.accepted, 1U);
  show(1);
  EXPECT_EQ(commanded_tick().result.reset_count, 2U);
  ASSERT_EQ(replies().size(), 1U);
  EXPECT_EQ(replies()[0].token, kToken);
  EXPECT_STREQ(dottrack_result_text(replies()[0].result), "done");
}

TEST_F(CommandedCycleTest, AnotherTargetIsAskedForOnce) {
  hear(protocol::CommandCode::set_target, 1);
  commanded_tick();
  EXPECT_TRUE(requests_.pending());
  EXPECT_EQ(requests_.take_target(), 1);
  EXPECT_EQ(requests_.take_target(), std::nullopt);
}

TEST_F(CommandedCycleTest, ATargetThatTheRigDoesNotHaveIsRefused) {
  hear(protocol::CommandCode::set_target, 2);
  const telemetry::CycleRecord& record = commanded_tick();
  EXPECT_FALSE(requests_.pending());
  EXPECT_EQ(record.counters.commands.rejected, 1U);
  ASSERT_EQ(replies().size(), 1U);
  EXPECT_STREQ(dottrack_result_text(replies()[0].result), "bad_argument");
}

TEST_F(CommandedCycleTest, TheVersionIsReportedAtOnce) {
  commanded_tick();
  commanded_tick();
  can_.sent_size = 0;
  hear(protocol::CommandCode::report_version);
  commanded_tick();  // is told after its group
  commanded_tick();
  const BusListener listener = listen();
  EXPECT_TRUE(listener.unit().has_version);
  EXPECT_TRUE(listener.unit().has_configuration);
}

TEST_F(CommandedCycleTest, AFloodOfCommandsIsHeardALittleATick) {
  for (int i = 0; i < 100; ++i) hear(protocol::CommandCode::acquire);
  commanded_tick();
  EXPECT_EQ(record_.counters.commands.accepted, 1U);
  EXPECT_GE(can_.heard.size(), 90U);
  commanded_tick();
  EXPECT_EQ(record_.counters.commands.accepted, 1U);
  EXPECT_GT(record_.counters.commands.rejected, 0U) << "too soon";
}

TEST_F(CycleTest, CommandsAreNotHeardUnlessAskedFor) {
  can_.heard.push_back(protocol::encode_command({}, {}, 1));
  tick();
  EXPECT_EQ(can_.heard.size(), 1U);
  EXPECT_EQ(record_.counters.commands.accepted, 0U);
}

}  // namespace
}  // namespace dottrack::cycle::test
