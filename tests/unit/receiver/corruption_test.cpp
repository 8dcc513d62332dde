// What the checksums find: exhaustively up to their guarantee, at the expected rate beyond.

#include <gtest/gtest.h>

#include <cstddef>
#include <random>

#include "tests/unit/receiver/frame_builder.h"
#include "tests/unit/receiver/listener.h"

namespace dottrack::receiver_test {
namespace {

struct Tally {
  std::uint64_t tried = 0;
  std::uint64_t found = 0;

  std::uint64_t missed() const { return tried - found; }
};

class Damager {
 public:
  void try_frame(const dottrack_frame& frame) {
    ++tally_.tried;
    if (listener_.push(frame, 0) == DOTTRACK_CORRUPTED) ++tally_.found;
  }
  const Tally& tally() const { return tally_; }

 private:
  Listener listener_;
  Tally tally_;
};

// Bit `at` in the order of the bus, which is also the checksum's: the top bit of a byte is first.
void flip_on_wire(dottrack_frame& frame, unsigned at) {
  flip_bit(frame, at / 8 * 8 + 7 - at % 8);
}

// From `at` on `length` bits of which the first and last are wrong, and those between by `pattern`.
dottrack_frame with_burst(const dottrack_frame& frame, unsigned at, unsigned length,
                          std::uint64_t pattern) {
  dottrack_frame damaged = frame;
  flip_on_wire(damaged, at);
  if (length > 1) flip_on_wire(damaged, at + length - 1);
  for (unsigned i = 0; i + 2 < length; ++i) {
    if (((pattern >> i) & 1U) != 0) flip_on_wire(damaged, at + 1 + i);
  }
  return damaged;
}

std::uint64_t patterns(unsigned length) {
  return length > 2 ? std::uint64_t{1} << (length - 2) : 1;
}

void all_bursts(const dottrack_frame& frame, unsigned first_bit, unsigned length,
                Damager& damager) {
  const unsigned bits = frame.length * 8U;
  for (unsigned at = first_bit; at + length <= bits; ++at) {
    for (std::uint64_t pattern = 0; pattern < patterns(length); ++pattern) {
      damager.try_frame(with_burst(frame, at, length, pattern));
    }
  }
}

TEST(ReceiverCorruption, EverySingleBitErrorOfEveryMessageIsFound) {
  std::mt19937_64 random(1);
  Damager damager;
  for (const unsigned message : every_message()) {
    const dottrack_frame frame = random_frame(random, message);
    ASSERT_NE(Listener().push(frame, 0), DOTTRACK_CORRUPTED) << message;
    all_bursts(frame, 0, 1, damager);
  }
  EXPECT_EQ(damager.tally().tried, 51U * 64U + 512U);
  EXPECT_EQ(damager.tally().missed(), 0U);
}

TEST(ReceiverCorruption, EveryBurstOfUpToSevenBitsIsFoundWhereverItBegins) {
  std::mt19937_64 random(2);
  Damager damager;
  for (const unsigned message : every_message()) {
    const dottrack_frame frame = random_frame(random, message);
    for (unsigned length = 2; length <= 7; ++length) all_bursts(frame, 0, length, damager);
  }
  EXPECT_GE(damager.tally().tried, 217'000U);
  EXPECT_EQ(damager.tally().missed(), 0U);
}

// Profile 2 puts the checksum before the data it is computed over, so an error in both is none of
// the bursts the polynomial is proof against: three of the 3648 bursts of 8 bits pass.
TEST(ReceiverCorruption, EveryBurstOfEightBitsWithinTheDataIsFound) {
  std::mt19937_64 random(3);
  Damager within;
  Damager anywhere;
  std::uint64_t frames = 0;
  for (const unsigned message : every_message()) {
    if (message == kFdPose) continue;
    const dottrack_frame frame = random_frame(random, message);
    all_bursts(frame, 8, 8, within);
    all_bursts(frame, 0, 8, anywhere);
    ++frames;
  }
  EXPECT_EQ(within.tally().tried, frames * 49U * 64U);
  EXPECT_EQ(within.tally().missed(), 0U);
  EXPECT_EQ(anywhere.tally().tried, frames * 57U * 64U);
  EXPECT_EQ(anywhere.tally().missed(), frames * 3U);
}

TEST(ReceiverCorruption, EveryBurstInAnFdFrameIsFound) {
  std::mt19937_64 random(4);
  const dottrack_frame frame = random_frame(random, kFdPose);
  Damager damager;
  for (unsigned length = 8; length <= 11; ++length) all_bursts(frame, 0, length, damager);
  for (unsigned i = 0; i < 200'000; ++i) {
    const auto length = 12U + static_cast<unsigned>(random() % 5);
    const auto at = 16U + static_cast<unsigned>(random() % (496U - length + 1));
    damager.try_frame(with_burst(frame, at, length, random()));
  }
  EXPECT_GE(damager.tally().tried, 680'000U);
  EXPECT_EQ(damager.tally().missed(), 0U);
}

TEST(ReceiverCorruption, AllErrorsOfTwoAndThreeBitsAreFound) {
  std::mt19937_64 random(5);
  const dottrack_frame frame = random_frame(random, kOrientation);
  Damager two;
  Damager three;
  for (unsigned a = 0; a < 64; ++a) {
    for (unsigned b = a + 1; b < 64; ++b) {
      dottrack_frame damaged = frame;
      flip_bit(damaged, a);
      flip_bit(damaged, b);
      two.try_frame(damaged);
      for (unsigned c = b + 1; c < 64; ++c) {
        dottrack_frame worse = damaged;
        flip_bit(worse, c);
        three.try_frame(worse);
      }
    }
  }
  EXPECT_EQ(two.tally().tried, 2016U);
  EXPECT_EQ(two.tally().missed(), 0U);
  EXPECT_EQ(three.tally().tried, 41664U);
  EXPECT_EQ(three.tally().missed(), 0U);
}

Tally random_payloads(unsigned message, unsigned count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Damager damager;
  dottrack_frame frame = random_frame(random, message);
  for (unsigned i = 0; i < count; ++i) {
    for (unsigned byte = 0; byte < frame.length; byte += 8) {
      const std::uint64_t word = random();
      for (unsigned k = 0; k < 8; ++k) {
        frame.data[byte + k] = static_cast<std::uint8_t>(word >> (8 * k));
      }
    }
    damager.try_frame(frame);
  }
  return damager.tally();
}

// Expected 1562.5 with a standard deviation of 39.4: bounds at five of them.
TEST(ReceiverCorruption, OneInTwoHundredAndFiftySixRandomPayloadsPasses) {
  for (const unsigned message : {kTime, kPosition2, kFirstDot + 7}) {
    const Tally tally = random_payloads(message, 400'000, 6 + message);
    EXPECT_EQ(tally.tried, 400'000U);
    EXPECT_GT(tally.missed(), 1562U - 197U) << message;
    EXPECT_LT(tally.missed(), 1563U + 197U) << message;
  }
}

// Expected 18.3 with a standard deviation of 4.3: bounds at four of them.
TEST(ReceiverCorruption, OneInSixtyFiveThousandRandomFdPayloadsPasses) {
  const Tally tally = random_payloads(kFdPose, 1'200'000, 7);
  EXPECT_GT(tally.missed(), 1U);
  EXPECT_LT(tally.missed(), 36U);
}

TEST(ReceiverCorruption, AFrameUnderAnotherMessagesIdentifierIsFound) {
  std::mt19937_64 random(8);
  Damager damager;
  for (const unsigned message : every_message()) {
    for (const unsigned other : every_message()) {
      if (message == other) continue;
      dottrack_frame frame = random_frame(random, message);
      frame.id = DOTTRACK_DEFAULT_BASE_ID + other;
      damager.try_frame(frame);
    }
  }
  EXPECT_EQ(damager.tally().tried, 52U * 51U);
  EXPECT_EQ(damager.tally().missed(), 0U);
}

TEST(ReceiverCorruption, EveryOtherLengthIsFound) {
  std::mt19937_64 random(9);
  Damager damager;
  for (const unsigned message : every_message()) {
    const dottrack_frame frame = random_frame(random, message);
    for (unsigned length = 0; length <= 255; ++length) {
      if (length == frame.length) continue;
      dottrack_frame other = frame;
      other.length = static_cast<std::uint8_t>(length);
      damager.try_frame(other);
    }
  }
  EXPECT_EQ(damager.tally().tried, 52U * 255U);
  EXPECT_EQ(damager.tally().missed(), 0U);
}

TEST(ReceiverCorruption, FramesOfOthersAreForeignAndChangeNothing) {
  std::mt19937_64 random(10);
  Listener listener;
  unsigned foreign = 0;
  for (std::uint32_t id = 0; id < 0x800; ++id) {
    const std::uint32_t offset = id - DOTTRACK_DEFAULT_BASE_ID;
    const bool ours = offset < 64 && (offset <= kLight || offset >= kFirstDot);
    dottrack_frame frame = random_frame(random, kStatus);
    frame.id = id;
    if (!ours && listener.push(frame, id) == DOTTRACK_FOREIGN) ++foreign;
    frame.extended = true;
    if (listener.push(frame, id) == DOTTRACK_FOREIGN) ++foreign;
  }
  EXPECT_EQ(foreign, 2U * 2048U - 52U);
  EXPECT_EQ(listener.counts().frames, 0U);
}

}  // namespace
}  // namespace dottrack::receiver_test
