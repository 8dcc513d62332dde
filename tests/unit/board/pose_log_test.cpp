#include "tests/board/harness/pose_log.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/core/protocol/pose_encoder.h"

namespace dottrack::board {
namespace {

using std::chrono::milliseconds;

protocol::PoseMessage tracking_at(double x_m) {
  protocol::PoseMessage message;
  message.state = core::State::tracking;
  message.reason = core::Reason::none;
  message.pose_valid = true;
  message.position_m = {x_m, 0.0, 0.0};
  return message;
}

void send(PoseLog& log, const protocol::PoseMessage& message, std::uint64_t counter,
          std::size_t frames = protocol::kFramesPerPose) {
  const auto encoded = protocol::encode(message, protocol::kDefaultBaseId, counter);
  for (std::size_t i = 0; i < frames; ++i) {
    std::string line = fmt::format("(1.000000) can1 {:03X}#", encoded[i].id);
    for (const auto byte : encoded[i].data) line += fmt::format("{:02X}", byte);
    log.take({Time{}, line});
  }
}

TEST(PoseLog, PutsMessagesTogether) {
  PoseLog log;
  send(log, tracking_at(1.5), 1);
  log.take({Time{}, "(1.0) can1 123#00"});
  send(log, {}, 2);
  ASSERT_EQ(log.size(), 2U);
  EXPECT_TRUE(is_pose(log.from(0)[0]));
  EXPECT_NEAR(log.from(0)[0].message.position_m.x(), 1.5, 1e-3);
  EXPECT_FALSE(is_pose(log.from(1)[0]));
}

TEST(PoseLog, WaitsForThoseThatFit) {
  PoseLog log;
  send(log, {}, 1);
  send(log, tracking_at(1.0), 2);
  send(log, tracking_at(2.0), 3);
  EXPECT_EQ(log.wait_for(is_pose, 2, 0, milliseconds(0)), 2U);
  EXPECT_FALSE(log.wait_for(is_pose, 2, 2, milliseconds(1)));
}

TEST(PoseLog, CountsWhatIsNotComplete) {
  PoseLog log;
  send(log, tracking_at(1.0), 1, 3);
  send(log, tracking_at(2.0), 2);
  EXPECT_EQ(log.size(), 1U);
  EXPECT_EQ(log.incomplete_groups(), 1U);
}

TEST(PoseLog, KnowsWhichBootAPoseIsOf) {
  PoseLog log;
  send(log, tracking_at(1.0), 1);
  log.start_boot();
  send(log, tracking_at(2.0), 1);
  EXPECT_EQ(log.from(0)[0].boot, 0U);
  EXPECT_EQ(log.from(0)[1].boot, 1U);
}

}  // namespace
}  // namespace dottrack::board
