// The bounds of frame lengths: hand-computed from the standard, and against frames built bit by
// bit.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string_view>

#include "app/core/protocol/bus_load.h"
#include "tests/unit/bus_load/bit_stream.h"

namespace dottrack::protocol {
namespace {

using test::LineFrame;

TEST(ClassicFrameLength, IsThatOfTheStandard) {
  EXPECT_EQ(classic_frame_bits({.extended = false, .fd = false, .bytes = 0}), 34U + 8U + 13U);
  EXPECT_EQ(classic_frame_bits({.extended = false, .fd = false, .bytes = 1}), 42U + 10U + 13U);
  EXPECT_EQ(classic_frame_bits({.extended = false, .fd = false, .bytes = 8}), 135U);
  EXPECT_EQ(classic_frame_bits({.extended = true, .fd = false, .bytes = 0}), 54U + 13U + 13U);
  EXPECT_EQ(classic_frame_bits({.extended = true, .fd = false, .bytes = 8}), 160U);
  EXPECT_DOUBLE_EQ(frame_time_s({}, {.arbitration = 250'000}), 135.0 / 250e3);
}

// 64 bytes: 17 + 3 stuff bits + 15 slow ones; 5 + 512 + 130 stuff bits + 32 of the checksum fast.
TEST(FdFrameTime, IsThatOfTheStandard) {
  const BitRates rates{.arbitration = 500'000, .data = 2'000'000};
  EXPECT_DOUBLE_EQ(frame_time_s({.extended = false, .fd = true, .bytes = 64}, rates),
                   35.0 / 500e3 + 679.0 / 2e6);
  // 29 bits: 36 + 8 + 15; 5 + 512 + 129 + 32.
  EXPECT_DOUBLE_EQ(frame_time_s({.extended = true, .fd = true, .bytes = 64}, rates),
                   59.0 / 500e3 + 678.0 / 2e6);
  // CRC-17: 17 + 3 + 15; 5 + 128 + 34 + 27.
  EXPECT_DOUBLE_EQ(frame_time_s({.extended = false, .fd = true, .bytes = 16}, rates),
                   35.0 / 500e3 + 194.0 / 2e6);
}

TEST(FdFrameTime, OfALengthThatDoesNotExistIsThatOfTheNextLonger) {
  for (const auto& [bytes, length] : {std::pair(9U, 12U), {13U, 16U}, {33U, 48U}, {63U, 64U}}) {
    EXPECT_EQ(frame_time_s({.extended = false, .fd = true, .bytes = bytes}, {}),
              frame_time_s({.extended = false, .fd = true, .bytes = length}, {}));
  }
}

TEST(BitStream, HasTheChecksumOfClassicCan) {
  std::vector<bool> bits;
  for (const char character : std::string_view("123456789")) {
    for (unsigned i = 8; i-- > 0;)
      bits.push_back(((static_cast<unsigned>(character) >> i) & 1U) != 0);
  }
  EXPECT_EQ(test::crc15(bits), 0x059EU);  // the check value of CRC-15/CAN
}

// A frame whose bits are such runs as make stuff bits often: random ones rarely do.
class Frames {
 public:
  LineFrame next(bool extended, std::size_t bytes) {
    LineFrame frame{.id = 0, .extended = extended, .data = std::vector<std::uint8_t>(bytes)};
    begin();
    for (unsigned i = extended ? 29 : 11; i-- > 0;) frame.id = frame.id << 1U | bit();
    begin();
    for (std::uint8_t& byte : frame.data) {
      for (unsigned i = 0; i < 8; ++i)
        byte = static_cast<std::uint8_t>(unsigned{byte} << 1U | bit());
    }
    return frame;
  }

 private:
  unsigned below(unsigned count) { return static_cast<unsigned>(random_() % count); }

  void begin() {
    run_ = 1 + below(5);
    value_ = below(2);
    mistakes_ = below(4);
  }

  // Mostly runs of four, from wherever the first one began; sometimes another length.
  unsigned bit() {
    if (run_ == 0) {
      value_ = 1 - value_;
      run_ = below(16) < mistakes_ ? 1 + below(5) : 4;
    }
    --run_;
    return value_;
  }

  std::mt19937 random_{42};
  unsigned run_ = 0;
  unsigned value_ = 0;
  unsigned mistakes_ = 0;
};

constexpr unsigned kFrames = 60'000;

class ClassicFrames : public testing::TestWithParam<bool> {};

TEST_P(ClassicFrames, AreNeverLongerThanTheBoundAndNearlyReachIt) {
  Frames frames;
  for (const unsigned bytes : {0U, 3U, 8U}) {
    const unsigned bound =
        classic_frame_bits({.extended = GetParam(), .fd = false, .bytes = bytes});
    std::size_t longest = 0;
    for (unsigned i = 0; i < kFrames; ++i) {
      longest = std::max(longest, test::classic_bits_on_line(frames.next(GetParam(), bytes)));
    }
    EXPECT_LE(longest, bound) << bytes << " bytes";
    EXPECT_GE(longest + 5, bound) << bytes << " bytes";
  }
}

INSTANTIATE_TEST_SUITE_P(Identifiers, ClassicFrames, testing::Bool());

class FdFrames : public testing::TestWithParam<bool> {};

// Some bits less than the bound are to be expected: FDF, the reserved bit and BRS are 1, 0, 1, and
// receivers that are near add nothing to CRC delimiter and ACK.
TEST_P(FdFrames, AreNeverLongerThanTheBoundAndNearlyReachIt) {
  Frames frames;
  const BitRates rates{.arbitration = 500'000, .data = 2'000'000};
  for (const unsigned bytes : {0U, 8U, 16U, 20U, 64U}) {
    const double bound = frame_time_s({.extended = GetParam(), .fd = true, .bytes = bytes}, rates);
    double longest = 0.0;
    for (unsigned i = 0; i < kFrames / 4; ++i) {
      const test::FdBits bits = test::fd_bits_on_line(frames.next(GetParam(), bytes));
      const double slow_s = static_cast<double>(bits.slow) / rates.arbitration;
      longest = std::max(longest, slow_s + static_cast<double>(bits.fast) / rates.data);
    }
    constexpr double kDistant_s = 2.0 / 500e3;
    EXPECT_LE(longest + kDistant_s, bound * (1 + 1e-12)) << bytes << " bytes";
    EXPECT_GE(longest + kDistant_s + 4.0 / 500e3, bound) << bytes << " bytes";
  }
}

INSTANTIATE_TEST_SUITE_P(Identifiers, FdFrames, testing::Bool());

}  // namespace
}  // namespace dottrack::protocol
