// Every raw number of every signal of the DBC: put where the encoder puts it, read where a reader
// with nothing but the DBC looks for it.

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "app/core/protocol/dbc_layout.h"
#include "tests/unit/protocol/dbc_reading.h"

namespace dottrack::protocol::test {
namespace {

using dbc::DbcMessage;
using dbc::DbcSignal;
using Bytes = std::array<std::uint8_t, 64>;

// All of them up to 16 bits; beyond, the ends, the powers of two with their neighbours and at
// least 10,000 others.
std::vector<std::uint64_t> raw_numbers(unsigned bits, std::mt19937_64& random) {
  const std::uint64_t end = std::uint64_t{1} << bits;
  std::vector<std::uint64_t> all;
  if (bits <= 16) {
    for (std::uint64_t raw = 0; raw < end; ++raw) all.push_back(raw);
    return all;
  }
  for (unsigned bit = 0; bit <= bits; ++bit) {
    const std::uint64_t power = std::uint64_t{1} << bit;
    for (const std::uint64_t raw : {power - 1, power, power + 1}) {
      if (raw < end) all.push_back(raw);
    }
  }
  for (int i = 0; i < 10000; ++i) all.push_back(random() % end);
  return all;
}

Bytes random_bytes(const DbcSignal& spared, std::mt19937_64& random) {
  Bytes bytes;
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  for (unsigned bit = spared.start; bit < spared.start + spared.length; ++bit) {
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] & ~(1U << (bit % 8)));
  }
  return bytes;
}

// By the encoder's code, into bytes that are taken already.
Bytes with_raw(Bytes bytes, const layout::NamedSignal& named, std::uint64_t raw) {
  LongPayload payload;
  for (std::size_t i = 0; i < 8; ++i) payload[i] = to_word(&bytes[8 * i]);
  if (named.message.length == 8) {
    payload[0] |= put(named.signal, raw);
  } else {
    put(named.signal, raw, payload);
  }
  for (std::size_t i = 0; i < 8; ++i) write_word(payload[i], &bytes[8 * i]);
  return bytes;
}

bool others_unchanged(const Bytes& before, const Bytes& after, const DbcSignal& signal) {
  for (unsigned i = 0; i < 64; ++i) {
    std::uint8_t changed = before[i] ^ after[i];
    for (unsigned bit = 8 * i; bit < 8 * i + 8; ++bit) {
      const bool own = bit >= signal.start && bit < signal.start + signal.length;
      if (own) changed = static_cast<std::uint8_t>(changed & ~(1U << (bit % 8)));
    }
    if (changed != 0) return false;
  }
  return true;
}

std::int64_t expected_reading(const DbcSignal& signal, std::uint64_t raw) {
  const auto value = static_cast<std::int64_t>(raw);
  const bool negative = signal.is_signed && ((raw >> (signal.length - 1)) & 1U) != 0;
  return negative ? value - (std::int64_t{1} << signal.length) : value;
}

// How many raw numbers came back; nothing if one did not.
std::size_t round_trips(const layout::NamedSignal& named, const DbcMessage& message,
                        const DbcSignal& signal, std::mt19937_64& random) {
  DbcMessage alone = message;
  alone.signals = {signal};
  std::size_t done = 0;
  for (const std::uint64_t raw : raw_numbers(signal.length, random)) {
    const Bytes before = random_bytes(signal, random);
    const Bytes after = with_raw(before, named, raw);
    const auto decoded = dbc::decode(alone, std::span(after).first(message.length_bytes));
    if (decoded.size() != 1 || decoded[0].raw != expected_reading(signal, raw)) return 0;
    if (!others_unchanged(before, after, signal)) return 0;
    ++done;
  }
  return done;
}

TEST(EveryRawValue, OfEverySignalComesBackAndLeavesItsNeighboursAlone) {
  std::mt19937_64 random(1);
  std::size_t signals = 0;
  std::size_t numbers = 0;
  for (const layout::NamedSignal& named : layout::kSignals) {
    const DbcMessage* message = layout_file().find(layout::kBaseId + named.message.offset, false);
    ASSERT_NE(message, nullptr);
    const DbcSignal* signal = message->signal(named.name);
    ASSERT_NE(signal, nullptr) << message->name << "." << named.name;
    const std::size_t expected = signal->length <= 16 ? std::size_t{1} << signal->length : 10000U;
    const std::size_t done = round_trips(named, *message, *signal, random);
    ASSERT_GE(done, expected) << message->name << "." << named.name;
    ++signals;
    numbers += done;
  }
  std::size_t in_the_dbc = 0;
  for (const DbcMessage& message : layout_file().messages) in_the_dbc += message.signals.size();
  EXPECT_EQ(signals, in_the_dbc);
  EXPECT_GT(numbers, 3'000'000U);
}

TEST(Layout, IsThatOfTheDbcSignalBySignal) {
  for (const layout::NamedSignal& named : layout::kSignals) {
    const DbcMessage& message = *layout_file().find(layout::kBaseId + named.message.offset, false);
    const DbcSignal& signal = *message.signal(named.name);
    EXPECT_EQ(named.message.length, message.length_bytes);
    EXPECT_EQ(std::to_string(named.message.data_id), message.attributes.at("E2EDataId"));
    EXPECT_EQ(named.signal.factor, signal.factor);
    EXPECT_EQ(named.signal.is_signed, signal.is_signed);
    bool marked = false;
    for (const auto& [raw, text] : signal.values) marked = marked || text == "not available";
    EXPECT_EQ(named.signal.has_not_available, marked) << message.name << "." << named.name;
    if (!marked) continue;
    const auto marker = signal.values.find(expected_reading(signal, named.signal.not_available()));
    ASSERT_NE(marker, signal.values.end());
    EXPECT_EQ(marker->second, "not available");
  }
}

}  // namespace
}  // namespace dottrack::protocol::test
