// dottrack.dbc against the encoder: what a DBC tool reads is what was sent.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "app/core/protocol/pose_decoder.h"
#include "app/core/protocol/pose_encoder.h"
#include "app/core/protocol/pose_layout.h"
#include "tests/unit/protocol/dbc_file.h"
#include "tests/unit/protocol/random_message.h"

namespace dottrack::protocol::test {
namespace {

using Readings = std::map<std::string, double>;

const std::map<std::uint32_t, DbcMessage>& dbc() {
  static const auto messages =
      read_dbc(std::filesystem::path(DOTTRACK_SOURCE_DIR) / "app/core/protocol/dottrack.dbc");
  return messages;
}

std::vector<std::uint8_t> bytes(const PoseFrame& frame) {
  return {frame.data.begin(), frame.data.end()};
}

// Everything a DBC tool would show of one group, the counter of each frame by itself.
Readings read_by_dbc(const PoseFrames& frames) {
  Readings readings;
  for (const PoseFrame& frame : frames) {
    const DbcMessage& message = dbc().at(frame.id);
    for (const auto& [name, signal] : message.signals) {
      const std::string key = name == "Counter" ? message.name + "." + name : name;
      readings[key] = signal.physical(bytes(frame));
    }
  }
  return readings;
}

PoseMessage decoded(const PoseFrames& frames) {
  PoseDecoder decoder;
  std::optional<PoseMessage> message;
  for (const PoseFrame& frame : frames) message = decoder.push(frame.id, frame.data);
  if (!message) throw std::runtime_error("five frames of one group made no message");
  return *message;
}

TEST(Dbc, HasTheFiveMessagesOfTheDefaultBaseAndNoOther) {
  ASSERT_EQ(dbc().size(), kFramesPerPose);
  for (std::uint32_t i = 0; i < kFramesPerPose; ++i) {
    ASSERT_TRUE(dbc().contains(kDefaultBaseId + i));
    EXPECT_EQ(dbc().at(kDefaultBaseId + i).length_bytes, 8U);
  }
}

TEST(Dbc, SignalsOfAMessageDoNotOverlapAndLeaveTheChecksumFree) {
  int signals = 0;
  for (const auto& [id, message] : dbc()) {
    std::set<unsigned> taken;
    for (const auto& [name, signal] : message.signals) {
      ++signals;
      EXPECT_TRUE(signal.intel) << name;
      EXPECT_GE(signal.start, 8U) << name;
      EXPECT_LE(signal.start + signal.length, 64U) << name;
      for (unsigned bit = signal.start; bit < signal.start + signal.length; ++bit) {
        EXPECT_TRUE(taken.insert(bit).second) << message.name << " bit " << bit;
      }
    }
  }
  EXPECT_EQ(signals, 21);
}

TEST(Dbc, ReadsWhatTheDecoderReads) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 5000; ++i) {
    const PoseFrames frames = encode(random_message(random), kDefaultBaseId, random());
    const Readings by_dbc = read_by_dbc(frames);
    const PoseMessage message = decoded(frames);
    ASSERT_EQ(by_dbc.at("Version"), kProtocolVersion);
    ASSERT_EQ(by_dbc.at("State"), static_cast<int>(message.state));
    ASSERT_EQ(by_dbc.at("Reason"), static_cast<int>(message.reason));
    ASSERT_EQ(by_dbc.at("PoseValid"), 1.0);
    ASSERT_EQ(by_dbc.at("OutOfRange"), 0.0);
    ASSERT_EQ(by_dbc.at("CamerasUsed"), message.cameras_used.bits());
    ASSERT_EQ(by_dbc.at("DotsUsed"), message.dots_used);
    ASSERT_EQ(by_dbc.at("ResetCount"), message.reset_count);
    ASSERT_EQ(by_dbc.at("MidExposure") * 1000.0,
              static_cast<double>(message.mid_exposure.time_since_epoch().count()));
    ASSERT_NEAR(by_dbc.at("X"), message.position_m.x(), 1e-10);
    ASSERT_NEAR(by_dbc.at("Y"), message.position_m.y(), 1e-10);
    ASSERT_NEAR(by_dbc.at("Z"), message.position_m.z(), 1e-10);
    Eigen::Quaterniond q(by_dbc.at("QW"), by_dbc.at("QX"), by_dbc.at("QY"), by_dbc.at("QZ"));
    ASSERT_LT((q.normalized().coeffs() - message.orientation.coeffs()).norm(), 1e-12);
  }
}

TEST(Dbc, EveryValueSentLiesWithinItsStatedLimits) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 2000; ++i) {
    for (const PoseFrame& frame : encode(random_message(random), kDefaultBaseId, random())) {
      for (const auto& [name, signal] : dbc().at(frame.id).signals) {
        const double value = signal.physical(bytes(frame));
        ASSERT_GE(value, signal.minimum - 1e-9) << name;
        ASSERT_LE(value, signal.maximum + 1e-9) << name;
      }
    }
  }
}

TEST(Dbc, KnowsTheCounterInEveryFrame) {
  const Readings readings = read_by_dbc(encode(PoseMessage{}, kDefaultBaseId, 11));
  int counters = 0;
  for (const auto& [name, value] : readings) {
    if (!name.ends_with(".Counter")) continue;
    ++counters;
    EXPECT_EQ(value, 11.0) << name;
  }
  EXPECT_EQ(counters, static_cast<int>(kFramesPerPose));
}

TEST(Dbc, NamesNotAvailableWhatAMessageWithoutAPoseCarries) {
  int named = 0;
  for (const PoseFrame& frame : encode(PoseMessage{}, kDefaultBaseId, 0)) {
    for (const auto& [name, signal] : dbc().at(frame.id).signals) {
      if (!signal.is_signed) continue;
      ++named;
      const auto raw = signal.raw(bytes(frame));
      ASSERT_TRUE(signal.values.contains(raw)) << name << " " << raw;
      EXPECT_EQ(signal.values.at(raw), "not available");
    }
  }
  EXPECT_EQ(named, 7);
}

TEST(Dbc, NamesStatesAndReasonsAsTheProgramDoes) {
  const auto& status = dbc().at(kDefaultBaseId).signals;
  EXPECT_EQ(status.at("State").values.size(), 2U);
  for (const auto& [number, name] : status.at("State").values) {
    EXPECT_EQ(name, core::to_string(static_cast<core::State>(number)));
  }
  const auto& reasons = status.at("Reason").values;
  for (const auto& [number, name] : reasons) {
    EXPECT_EQ(name, core::to_string(static_cast<core::Reason>(number)));
  }
  for (int number = 0; number < 256; ++number) {
    const bool known = core::to_string(static_cast<core::Reason>(number)) != "unknown";
    EXPECT_EQ(reasons.contains(number), known) << "reason " << number;
  }
}

}  // namespace
}  // namespace dottrack::protocol::test
