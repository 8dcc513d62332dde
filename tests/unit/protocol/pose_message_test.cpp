#include "app/core/protocol/pose_message.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "app/core/protocol/pose_decoder.h"
#include "app/core/protocol/pose_encoder.h"
#include "app/core/protocol/pose_layout.h"
#include "tests/unit/protocol/random_message.h"

namespace dottrack::protocol {
namespace {

using test::random_message;

constexpr double kDegreesPerRadian = 57.295779513082320877;

std::optional<PoseMessage> push_all(PoseDecoder& decoder, const PoseFrames& frames) {
  std::optional<PoseMessage> last;
  for (const PoseFrame& frame : frames) last = decoder.push(frame.id, frame.data);
  return last;
}

PoseMessage round_trip(const PoseMessage& message) {
  PoseDecoder decoder(0x123);
  const auto got = push_all(decoder, encode(message, 0x123, 5));
  if (!got) throw std::runtime_error("five frames of one group made no message");
  return *got;
}

TEST(PoseMessage, ComesBackWithinHalfAStepOfPositionAndTime) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    const PoseMessage sent = random_message(random);
    const PoseMessage got = round_trip(sent);
    ASSERT_TRUE(got.pose_valid);
    ASSERT_LE((got.position_m - sent.position_m).cwiseAbs().maxCoeff(), 0.00005 + 1e-12);
    const auto late = sent.mid_exposure - got.mid_exposure;
    ASSERT_GE(late, Duration(0));
    ASSERT_LT(late, std::chrono::microseconds(1));
  }
}

TEST(PoseMessage, RoundingTurnsTheAttitudeByLessThanFiveThousandthsOfADegree) {
  std::mt19937_64 random(2);
  double worst_deg = 0.0;
  for (int i = 0; i < 100000; ++i) {
    PoseMessage sent = random_message(random);
    const PoseMessage got = round_trip(sent);
    const double error = sent.orientation.angularDistance(got.orientation) * kDegreesPerRadian;
    worst_deg = std::max(worst_deg, error);
  }
  EXPECT_LT(worst_deg, 0.005);
  EXPECT_GT(worst_deg, 0.0005);  // the bound is of the size that the layout's comment derives
}

TEST(PoseMessage, TheSignOfTheQuaternionSurvives) {
  PoseMessage sent;
  sent.pose_valid = true;
  sent.orientation = Eigen::Quaterniond(-0.5, 0.5, -0.5, 0.5);
  EXPECT_LT((round_trip(sent).orientation.coeffs() - sent.orientation.coeffs()).norm(), 1e-9);
}

TEST(PoseMessage, StatusComesBackAsItWas) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 1000; ++i) {
    const PoseMessage sent = random_message(random);
    const PoseMessage got = round_trip(sent);
    ASSERT_EQ(got.state, sent.state);
    ASSERT_EQ(got.reason, sent.reason);
    ASSERT_EQ(got.cameras_used, sent.cameras_used);
    ASSERT_EQ(got.dots_used, sent.dots_used);
    ASSERT_EQ(got.reset_count, sent.reset_count);
    ASSERT_FALSE(got.out_of_range);
  }
}

TEST(PoseMessage, WithoutAPoseNothingOfAnOldOneIsOnTheBus) {
  std::mt19937_64 random(4);
  PoseMessage one = random_message(random);
  PoseMessage other = one;
  other.position_m += Eigen::Vector3d(1, 2, 3);
  other.orientation = other.orientation.conjugate();
  one.pose_valid = other.pose_valid = false;
  const PoseFrames frames = encode(one, kDefaultBaseId, 3);
  const PoseFrames other_frames = encode(other, kDefaultBaseId, 3);
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].data, other_frames[i].data);
  const PoseMessage got = round_trip(one);
  EXPECT_FALSE(got.pose_valid);
  EXPECT_EQ(got.position_m, Eigen::Vector3d::Zero());
}

TEST(PoseMessage, APoseThatDoesNotFitIsSaidNotToFit) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const double x : {839.0, -839.0, 1e300, kNaN}) {
    PoseMessage sent;
    sent.pose_valid = true;
    sent.position_m.x() = x;
    const PoseMessage got = round_trip(sent);
    EXPECT_FALSE(got.pose_valid) << x;
    EXPECT_TRUE(got.out_of_range) << x;
  }
  PoseMessage no_unit;
  no_unit.pose_valid = true;
  no_unit.orientation.coeffs().setZero();
  EXPECT_FALSE(round_trip(no_unit).pose_valid);
}

TEST(PoseMessage, TheCounterBindsTheGroupAndCountsModulo16) {
  const PoseFrames frames = encode(PoseMessage{}, kDefaultBaseId, 16 + 9);
  for (const PoseFrame& frame : frames) EXPECT_EQ(get(layout::kCounter, to_word(frame.data)), 9U);
  for (std::uint32_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].id, kDefaultBaseId + i);
}

TEST(PoseDecoder, MixesNoTwoGroups) {
  std::mt19937_64 random(5);
  const PoseFrames first = encode(random_message(random), kDefaultBaseId, 1);
  const PoseFrames second = encode(random_message(random), kDefaultBaseId, 2);
  PoseDecoder decoder;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(decoder.push(first[i].id, first[i].data));
  for (std::size_t i = 3; i < 5; ++i) EXPECT_FALSE(decoder.push(second[i].id, second[i].data));
  EXPECT_EQ(decoder.incomplete_groups(), 1U);
  EXPECT_TRUE(push_all(decoder, encode(random_message(random), kDefaultBaseId, 3)));
  EXPECT_EQ(decoder.incomplete_groups(), 2U);
}

TEST(PoseDecoder, AFrameAgainStartsANewGroupEvenWithTheSameCounter) {
  std::mt19937_64 random(6);
  const PoseMessage sent = random_message(random);
  PoseDecoder decoder;
  const PoseFrames old = encode(random_message(random), kDefaultBaseId, 7);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_FALSE(decoder.push(old[i].id, old[i].data));
  const auto got = push_all(decoder, encode(sent, kDefaultBaseId, 7));
  ASSERT_TRUE(got);
  EXPECT_EQ(got->reset_count, sent.reset_count);
  EXPECT_EQ(decoder.incomplete_groups(), 1U);
}

TEST(PoseDecoder, LeavesOtherIdentifiersAlone) {
  const PoseFrames frames = encode(PoseMessage{}, kDefaultBaseId, 0);
  PoseDecoder decoder;
  for (std::size_t i = 0; i < 4; ++i) decoder.push(frames[i].id, frames[i].data);
  decoder.push(kDefaultBaseId - 1, Payload{});
  decoder.push(kDefaultBaseId + 5, Payload{});
  EXPECT_TRUE(decoder.push(frames[4].id, frames[4].data));
  EXPECT_EQ(decoder.incomplete_groups(), 0U);
}

TEST(PoseDecoder, GivesNoMessageOfAVersionItDoesNotKnow) {
  PoseFrames frames = encode(PoseMessage{}, kDefaultBaseId, 0);
  frames[0].data[1] = static_cast<std::uint8_t>(frames[0].data[1] ^ 0xF0);
  PoseDecoder decoder;
  EXPECT_FALSE(push_all(decoder, frames));
  EXPECT_EQ(decoder.foreign_versions(), 1U);
}

TEST(PoseDecoder, BelievesNoPoseThatIsMarkedNotAvailable) {
  PoseMessage without;
  PoseFrames frames = encode(without, kDefaultBaseId, 0);
  frames[0].data[2] = static_cast<std::uint8_t>(frames[0].data[2] | 0x04);  // PoseValid
  PoseDecoder decoder;
  const auto got = push_all(decoder, frames);
  ASSERT_TRUE(got);
  EXPECT_FALSE(got->pose_valid);
}

}  // namespace
}  // namespace dottrack::protocol
