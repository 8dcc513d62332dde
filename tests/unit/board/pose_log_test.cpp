#include "tests/board/harness/pose_log.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/core/protocol/pose_encoder.h"

namespace dottrack::board {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// A group of the given sequence, its capture that many ticks after the start of the unit's clock.
protocol::PoseMessage tracking_at(double x_m, int tick) {
  protocol::PoseMessage message;
  message.state = core::State::tracking;
  message.reason = core::Reason::none;
  message.pose_valid = true;
  message.position_m = {x_m, 0.0, 0.0};
  message.mid_exposure = Time(milliseconds(1000 + 400 * tick));
  return message;
}

protocol::PoseMessage acquiring_at(int tick) {
  protocol::PoseMessage message;
  message.mid_exposure = Time(milliseconds(1000 + 400 * tick));
  return message;
}

// What candump prints of it.
std::vector<std::string> lines_of(const protocol::PoseMessage& message, std::uint8_t sequence) {
  protocol::GroupFrames frames;
  protocol::encode_group(message, {}, {}, sequence, frames);
  std::vector<std::string> lines;
  for (const hal::CanFrame& frame : frames) {
    lines.push_back(fmt::format("(1.000000) can1 {:03X}#", frame.id));
    for (const auto byte : frame.payload()) lines.back() += fmt::format("{:02X}", byte);
  }
  return lines;
}

void send(PoseLog& log, const protocol::PoseMessage& message, std::uint8_t sequence,
          std::size_t left_out = 0) {
  const auto lines = lines_of(message, sequence);
  for (std::size_t i = 0; i + left_out < lines.size(); ++i) {
    log.take({message.mid_exposure, lines[i]});
  }
}

TEST(PoseLog, PutsMessagesTogether) {
  PoseLog log;
  send(log, tracking_at(1.5, 0), 1);
  log.take({Time{}, "(1.0) can1 123#00"});
  log.take({Time{}, "candump is no more"});
  send(log, acquiring_at(1), 2);
  ASSERT_EQ(log.size(), 2U);
  EXPECT_TRUE(is_pose(log.from(0)[0]));
  EXPECT_TRUE(log.from(0)[0].fresh);
  EXPECT_NEAR(position_m(log.from(0)[0]).x(), 1.5, 1e-3);
  EXPECT_EQ(mid_exposure(log.from(0)[0]), Time(seconds(1)));
  EXPECT_FALSE(is_pose(log.from(1)[0]));
}

TEST(PoseLog, WaitsForThoseThatFit) {
  PoseLog log;
  send(log, acquiring_at(0), 1);
  send(log, tracking_at(1.0, 1), 2);
  send(log, tracking_at(2.0, 2), 3);
  EXPECT_EQ(log.wait_for(is_pose, 2, 0, milliseconds(0)), 2U);
  EXPECT_FALSE(log.wait_for(is_pose, 2, 2, milliseconds(1)));
}

TEST(PoseLog, CountsWhatIsNotWhole) {
  PoseLog log;
  send(log, tracking_at(1.0, 0), 1);
  send(log, tracking_at(1.0, 1), 2, 1);
  send(log, tracking_at(2.0, 2), 3);
  auto damaged = lines_of(tracking_at(3.0, 3), 4).front();
  damaged.back() = damaged.back() == '0' ? '1' : '0';
  log.take({Time(seconds(3)), damaged});
  EXPECT_EQ(log.size(), 2U);
  EXPECT_EQ(log.counts().incomplete, 1U);
  EXPECT_EQ(log.counts().corrupted, 1U);
}

TEST(PoseLog, KnowsWhichBootAPoseIsOf) {
  PoseLog log;
  send(log, tracking_at(1.0, 100), 1);
  log.start_boot();
  auto after = tracking_at(2.0, 0);
  for (const auto& line : lines_of(after, 1)) log.take({Time(seconds(100)), line});
  ASSERT_EQ(log.size(), 2U);
  EXPECT_EQ(log.from(0)[0].boot, 0U);
  EXPECT_EQ(log.from(0)[1].boot, 1U);
  EXPECT_TRUE(log.from(0)[1].message.restarted);
  EXPECT_EQ(log.counts().restarts, 1U);
}

TEST(PoseLog, KnowsWhatTheUnitIs) {
  PoseLog log;
  EXPECT_FALSE(log.unit().has_version);
  protocol::IdentityMessage identity;
  identity.minor = 1;
  identity.config_hash = 0x12345678;
  for (const auto& frame : protocol::encode_identity(identity, {}, 1)) {
    std::string line = fmt::format("(1.000000) can1 {:03X}#", frame.id);
    for (const auto byte : frame.payload()) line += fmt::format("{:02X}", byte);
    log.take({Time(seconds(1)), line});
  }
  EXPECT_TRUE(log.unit().has_version && log.unit().has_configuration);
  EXPECT_EQ(log.unit().config_hash, 0x12345678U);
}

}  // namespace
}  // namespace dottrack::board
