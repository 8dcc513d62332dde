// dottrack.dbc by itself and against the names and numbers of the program.

#include <gtest/gtest.h>

#include <set>

#include "app/core/protocol/command.h"
#include "app/core/protocol/degraded.h"
#include "tests/unit/protocol/dbc_reading.h"
#include "tests/unit/protocol/random_message.h"

namespace dottrack::protocol::test {
namespace {

using dbc::DbcMessage;
using dbc::DbcSignal;
using Values = std::map<std::int64_t, std::string>;

constexpr std::uint32_t kLongOne = kDefaultBaseId + 16;

TEST(Dbc, HasTheMessagesOfTheDefaultBaseAndNoOther) {
  std::set<std::uint32_t> ids;
  for (const DbcMessage& message : layout_file().messages) {
    EXPECT_FALSE(message.extended);
    EXPECT_TRUE(ids.insert(message.id).second);
    EXPECT_EQ(message.length_bytes, message.id == kLongOne ? 64U : 8U) << message.name;
    EXPECT_EQ(message.sender, message.name == "DOTTRACK_Command" ? "Receiver" : "DOTTRACK");
    EXPECT_FALSE(message.comment.empty()) << message.name;
  }
  std::set<std::uint32_t> expected;
  for (std::uint32_t i = 0; i < 20; ++i) expected.insert(kDefaultBaseId + i);
  for (std::uint32_t i = 32; i < kIdentifiers; ++i) expected.insert(kDefaultBaseId + i);
  EXPECT_EQ(ids, expected);
}

TEST(Dbc, SignalsOfAMessageDoNotOverlap) {
  int signals = 0;
  for (const DbcMessage& message : layout_file().messages) {
    std::set<unsigned> taken;
    for (const DbcSignal& signal : message.signals) {
      ++signals;
      EXPECT_TRUE(signal.intel) << signal.name;
      EXPECT_LE(signal.start + signal.length, 8 * message.length_bytes) << signal.name;
      for (unsigned bit = signal.start; bit < signal.start + signal.length; ++bit) {
        EXPECT_TRUE(taken.insert(bit).second) << message.name << " bit " << bit;
      }
    }
  }
  EXPECT_GT(signals, 250);
}

TEST(Dbc, EveryMessageBeginsWithChecksumAndSequence) {
  for (const DbcMessage& message : layout_file().messages) {
    const unsigned crc_bits = message.id == kLongOne ? 16 : 8;
    ASSERT_GE(message.signals.size(), 3U);
    EXPECT_EQ(message.signals[0].name, "CRC");
    EXPECT_EQ(message.signals[0].start, 0U);
    EXPECT_EQ(message.signals[0].length, crc_bits);
    EXPECT_EQ(message.signals[1].name, "Sequence");
    EXPECT_EQ(message.signals[1].start, crc_bits);
    EXPECT_EQ(message.signals[1].length, 8U);
  }
}

TEST(Dbc, DataIdsAreDistinctAndThoseOfTheProtocol) {
  std::set<std::string> ids;
  for (const DbcMessage& message : layout_file().messages) {
    const std::string& id = message.attributes.at("E2EDataId");
    EXPECT_TRUE(ids.insert(id).second) << message.name;
    const bool long_one = message.id == kLongOne;
    EXPECT_EQ(id, std::to_string(long_one ? 0xD07A : message.id - kDefaultBaseId + 1));
  }
  const DbcMessage& fd_pose = layout_of("FdPose");
  EXPECT_EQ(fd_pose.attributes.at("E2EProfile"), "1");
  EXPECT_EQ(fd_pose.attributes.at("VFrameFormat"), "14");  // StandardCAN_FD
}

// The ends of what a raw number can say, the marker left out.
std::pair<std::int64_t, std::int64_t> raw_range(const DbcSignal& signal) {
  const std::int64_t top = std::int64_t{1} << (signal.length - (signal.is_signed ? 1U : 0U));
  if (signal.is_signed) return {-(top - 1), top - 1};
  const auto marker = signal.values.find(top - 1);
  const bool marked = marker != signal.values.end() && marker->second == "not available";
  return {0, top - (marked ? 2 : 1)};
}

// A range may be narrower than its bits; never wider, and never past the marker.
TEST(Dbc, RangesAreWithinWhatTheBitsCanSay) {
  const std::set<std::string> narrower{"DotsUsed", "DotsFollow", "Cameras", "Unused", "QW",
                                       "QX",       "QY",         "QZ",      "Opening"};
  for (const DbcMessage& message : layout_file().messages) {
    for (const DbcSignal& signal : message.signals) {
      const auto [least, most] = raw_range(signal);
      const double slack = 0.51 * signal.factor;
      EXPECT_GE(signal.minimum, static_cast<double>(least) * signal.factor - slack) << signal.name;
      EXPECT_LE(signal.maximum, static_cast<double>(most) * signal.factor + slack) << signal.name;
      if (narrower.contains(signal.name) || signal.name.starts_with("Corr")) continue;
      EXPECT_NEAR(signal.minimum, static_cast<double>(least) * signal.factor, 1e-9) << signal.name;
      EXPECT_NEAR(signal.maximum, static_cast<double>(most) * signal.factor, 1e-9) << signal.name;
    }
  }
}

TEST(Dbc, NamesTheMarkerOfEverySignedSignal) {
  int markers = 0;
  for (const DbcMessage& message : layout_file().messages) {
    for (const DbcSignal& signal : message.signals) {
      if (!signal.is_signed) continue;
      ++markers;
      const std::int64_t marker = -(std::int64_t{1} << (signal.length - 1));
      ASSERT_TRUE(signal.values.contains(marker)) << message.name << "." << signal.name;
      EXPECT_EQ(signal.values.at(marker), "not available");
    }
  }
  EXPECT_EQ(markers, 2 * 7 + 6 + 2 * 15 + 16 * 3);
}

TEST(Dbc, EveryValueSentLiesWithinItsStatedLimits) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 500; ++i) {
    const PoseMessage message = random_message(random);
    for (const Addressing& addressing : {classic(), fd()}) {
      const Reading reading(encoded(message, addressing));
      for (const auto& [name, decoded] : reading.signals()) {
        if (decoded.text == "not available") continue;
        ASSERT_GE(decoded.physical, decoded.signal->minimum - 1e-9) << name;
        ASSERT_LE(decoded.physical, decoded.signal->maximum + 1e-9) << name;
      }
    }
  }
}

TEST(Dbc, AllDotsAreAlike) {
  for (unsigned dot = 2; dot <= 16; ++dot) {
    for (const char* part : {"Position", "Detail"}) {
      const DbcMessage& first = layout_of(std::string("Dot1") + part);
      const DbcMessage& other = layout_of("Dot" + std::to_string(dot) + part);
      EXPECT_EQ(other.id, first.id + 2 * (dot - 1));
      ASSERT_EQ(other.signals.size(), first.signals.size());
      for (std::size_t i = 0; i < first.signals.size(); ++i) {
        const DbcSignal& a = first.signals[i];
        const DbcSignal& b = other.signals[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.start, b.start);
        EXPECT_EQ(a.length, b.length);
        EXPECT_EQ(a.is_signed, b.is_signed);
        EXPECT_EQ(a.factor, b.factor);
        EXPECT_EQ(a.values, b.values);
      }
    }
  }
}

// A name for each number that the program has a name for, and no other.
template <class Enumeration>
void expect_names(const Values& values) {
  for (int number = 0; number < 256; ++number) {
    const std::string_view name = to_string(static_cast<Enumeration>(number));
    EXPECT_EQ(values.contains(number), name != "unknown") << number;
    if (values.contains(number)) {
      EXPECT_EQ(values.at(number), name);
    }
  }
}

TEST(Dbc, NamesStatesReasonsAndResultsAsTheProgramDoes) {
  for (const char* message : {"Status", "FdPose"}) {
    const Values states{{0, std::string(to_string(core::State::acquiring))},
                        {1, std::string(to_string(core::State::tracking))}};
    EXPECT_EQ(layout_of(message).signal("State")->values, states);
    expect_names<core::Reason>(layout_of(message).signal("Reason")->values);
  }
  expect_names<CommandResult>(layout_of("Reply").signal("Result")->values);
}

TEST(Dbc, NamesLightAndIris) {
  const Values states{{0, "off"},      {1, "searching"},  {2, "settling"},  {3, "steady"},
                      {4, "too_dark"}, {5, "too_bright"}, {6, "iris_fault"}};
  EXPECT_EQ(layout_of("Light").signal("LightState")->values, states);
  const Values irises{{0, "automatic"}, {1, "ok"}, {2, "at_end"}, {3, "fault"}};
  EXPECT_EQ(layout_of("Light").signal("Iris")->values, irises);
}

TEST(Dbc, NamesCommandsInBothDirections) {
  const Values commands{{1, "acquire"}, {2, "set_target"}, {3, "report_version"}};
  EXPECT_EQ(layout_of("Command").signal("Command")->values, commands);
  EXPECT_EQ(layout_of("Reply").signal("Command")->values, commands);
}

TEST(Dbc, NamesCameraHealthAndVisibility) {
  const Values health{{0, "absent"}, {1, "used"},     {2, "unused"},     {3, "no_frame"},
                      {4, "stale"},  {5, "overflow"}, {6, "iris_fault"}, {7, "moved"}};
  for (const DbcSignal& signal : layout_of("Cameras").signals) {
    if (!signal.name.starts_with("Camera")) continue;
    EXPECT_EQ(signal.values, health) << signal.name;
  }
  const Values visibility{{0, "not_seen"}, {1, "one_camera"}, {2, "located"}};
  EXPECT_EQ(layout_of("Dot1Detail").signal("Visibility")->values, visibility);
}

TEST(Dbc, ExplainsEveryBitOfDegraded) {
  for (const char* message : {"Quality", "FdPose"}) {
    const std::string& comment = layout_of(message).signal("Degraded")->comment;
    for (unsigned bit = 0; bit < 16; ++bit) {
      const std::string_view name = to_string(static_cast<Degraded>(bit));
      EXPECT_EQ(name != "unknown", bit < kDegradedReasons);
      if (bit >= kDegradedReasons) continue;
      const std::string entry = " " + std::to_string(bit) + " " + std::string(name);
      EXPECT_NE(comment.find(entry), std::string::npos) << entry;
    }
  }
}

}  // namespace
}  // namespace dottrack::protocol::test
