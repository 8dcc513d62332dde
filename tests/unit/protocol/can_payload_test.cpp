#include "app/core/protocol/can_payload.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/core/protocol/layout_types.h"
#include "app/core/protocol/rounding.h"

namespace dottrack::protocol {
namespace {

using layout::Signal;

TEST(CanPayload, BitNLiesInByteNOver8LeastSignificantFirst) {
  const Payload payload = to_payload(put(Field{12, 8}, 0xAB));
  EXPECT_EQ(payload, (Payload{0x00, 0xB0, 0x0A, 0, 0, 0, 0, 0}));
  EXPECT_EQ(get(Field{12, 8}, to_word(payload)), 0xABU);
}

TEST(CanPayload, AFieldLeavesItsNeighboursAlone) {
  const std::uint64_t word = put(Field{16, 24}, ~std::uint64_t{0});
  EXPECT_EQ(get(Field{0, 16}, word), 0U);
  EXPECT_EQ(get(Field{40, 24}, word), 0U);
}

TEST(CanPayload, ALongFieldIsNotCutShort) {
  const std::uint64_t value = (std::uint64_t{1} << 48) - 2;
  EXPECT_EQ(get(Field{16, 48}, put(Field{16, 48}, value)), value);
}

TEST(CanPayload, AFieldOf64BytesMayLieAcrossWords) {
  int straddling = 0;
  for (unsigned length = 1; length <= 52; ++length) {
    for (unsigned start = 0; start + length <= 512; ++start) {
      LongPayload payload{};
      put(Field{start, length}, ~std::uint64_t{0}, payload);
      straddling += start / 64 != (start + length - 1) / 64 ? 1 : 0;
      unsigned wrong = 0;
      for (unsigned bit = 0; bit < 512; ++bit) {
        const bool set = ((payload[bit / 64] >> (bit % 64)) & 1U) != 0;
        wrong += set != (bit >= start && bit < start + length) ? 1U : 0U;
      }
      ASSERT_EQ(wrong, 0U) << start << "|" << length;
    }
  }
  EXPECT_EQ(straddling, 7 * (51 * 52 / 2));
}

TEST(Signal, KnowsItsLargestValueAndItsMarker) {
  const Signal number{{0, 16}, true, true, 0.5};
  EXPECT_EQ(number.largest(), 32767);
  EXPECT_EQ(number.not_available(), 0x8000U);
  const Signal amount{{0, 8}, false, true, 0.5};
  EXPECT_EQ(amount.largest(), 254);
  EXPECT_EQ(amount.not_available(), 255U);
  EXPECT_EQ((Signal{{0, 8}, false, false, 0.5}.largest()), 255);
}

TEST(Rounding, IsToTheNearestAndToTheEvenOneOfTwo) {
  EXPECT_EQ(nearest(0.49999999999999994), 0);
  EXPECT_EQ(nearest(0.5), 0);
  EXPECT_EQ(nearest(1.5), 2);
  EXPECT_EQ(nearest(-1.5), -2);
  EXPECT_EQ(nearest(-8388607.4), -8388607);
  EXPECT_EQ(nearest(2251799813685247.0), 2251799813685247);
}

TEST(Rounding, UpIsNeverBelowAndNeverAStepTooMuch) {
  const Signal signal{{0, 16}, false, true, 0.000005};
  for (std::int64_t raw = 0; raw <= signal.largest(); ++raw) {
    const double value = static_cast<double>(raw) * signal.factor;
    ASSERT_EQ(rounded_up(signal, value), raw);
    ASSERT_EQ(rounded_up(signal, std::nextafter(value, 1.0)), raw + 1);
  }
}

}  // namespace
}  // namespace dottrack::protocol
