// Checksums against the published check values and against a reckoning bit by bit.

#include "app/core/protocol/e2e.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/unit/protocol/dbc_reading.h"
#include "tests/unit/protocol/random_message.h"

namespace dottrack::protocol::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

unsigned crc_bit_by_bit(unsigned width, unsigned polynomial, const Bytes& bytes) {
  const unsigned top = 1U << (width - 1U);
  unsigned crc = (top << 1U) - 1U;
  for (const std::uint8_t byte : bytes) {
    for (int bit = 7; bit >= 0; --bit) {
      const bool one = ((byte >> bit) & 1) != 0;
      const bool feedback = ((crc & top) != 0) != one;
      crc = ((crc << 1U) ^ (feedback ? polynomial : 0U)) & ((top << 1U) - 1U);
    }
  }
  return crc;
}

unsigned profile2_by_table(const Bytes& bytes) {
  std::uint8_t crc = e2e::kCrc8Start;
  for (const std::uint8_t byte : bytes) crc = e2e::crc8(crc, byte);
  return static_cast<std::uint8_t>(~crc);
}

TEST(EndToEnd, GivesTheCheckValuesOfTheProfiles) {
  // Data, then the data ID.
  EXPECT_EQ(profile2_by_table({0x01, 0x02, 0x03, 0x12}), 0x5FU);
  EXPECT_EQ(profile2_by_table({0x01, 0x02, 0x03, 0xFF}), 0xEDU);
  EXPECT_EQ(profile2_by_table({0x01, 0x23, 0x45, 0x67, 0x89, 0xA5}), 0x1AU);
  // CRC-8 and CRC-16 of "123456789".
  const Bytes digits{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(profile2_by_table(digits), 0xDFU);
  std::uint16_t crc = e2e::kCrc16Start;
  for (const std::uint8_t byte : digits) crc = e2e::crc16(crc, byte);
  EXPECT_EQ(crc, 0x29B1U);
}

TEST(EndToEnd, EightBytesAtOnceAreAsOneAfterTheOther) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    LongPayload payload;
    for (std::uint64_t& word : payload) word = random();
    const auto id = static_cast<std::uint16_t>(random());
    Bytes eight;
    for (const std::uint8_t byte : to_payload(payload[0])) eight.push_back(byte);
    eight.erase(eight.begin());
    eight.push_back(static_cast<std::uint8_t>(id));
    const auto crc8 = static_cast<std::uint8_t>(~crc_bit_by_bit(8, 0x2F, eight));
    ASSERT_EQ(e2e::profile2_crc(payload[0], id & 0xFFU), crc8);
    Bytes all;
    for (const std::uint64_t word : payload) {
      for (const std::uint8_t byte : to_payload(word)) all.push_back(byte);
    }
    all.erase(all.begin(), all.begin() + 2);
    all.push_back(static_cast<std::uint8_t>(id));
    all.push_back(static_cast<std::uint8_t>(id >> 8U));
    ASSERT_EQ(e2e::profile5_crc(payload, id), crc_bit_by_bit(16, 0x1021, all));
  }
}

// By the DBC's attributes alone.
unsigned expected_crc(const hal::CanFrame& frame) {
  const dbc::DbcMessage& message = *layout_file().find(frame.id, false);
  const int id = std::stoi(message.attributes.at("E2EDataId"));
  const bool long_one = frame.length == 64;
  Bytes bytes(frame.data.begin() + (long_one ? 2 : 1), frame.data.begin() + frame.length);
  bytes.push_back(static_cast<std::uint8_t>(id));
  if (!long_one) return crc_bit_by_bit(8, 0x2F, bytes) ^ 0xFFU;
  bytes.push_back(static_cast<std::uint8_t>(id >> 8));
  return crc_bit_by_bit(16, 0x1021, bytes);
}

TEST(EndToEnd, EveryFrameOfAGroupCarriesItsChecksumAndTheSequence) {
  std::mt19937_64 random(2);
  int frames = 0;
  for (int i = 0; i < 500; ++i) {
    PoseMessage message = random_message(random);
    message.dots_known = 16;
    const auto sequence = static_cast<std::uint8_t>(i);
    for (const Addressing& addressing : {classic(), fd()}) {
      for (const hal::CanFrame& frame : encoded(message, addressing, kAllParts, sequence)) {
        ++frames;
        const bool long_one = frame.length == 64;
        const unsigned crc =
            long_one ? frame.data[0] | unsigned{frame.data[1]} << 8U : frame.data[0];
        ASSERT_EQ(crc, expected_crc(frame)) << frame.id;
        ASSERT_EQ(frame.data[long_one ? 2 : 1], sequence);
      }
    }
  }
  EXPECT_EQ(frames, 500 * (46 + 36));
}

}  // namespace
}  // namespace dottrack::protocol::test
