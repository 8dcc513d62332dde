#include "app/core/protocol/can_payload.h"

#include <gtest/gtest.h>

namespace dottrack::protocol {
namespace {

TEST(CanPayload, BitNLiesInByteNOver8LeastSignificantFirst) {
  const Payload payload = to_payload(put(Field{12, 8}, 0xAB));
  EXPECT_EQ(payload, (Payload{0x00, 0xB0, 0x0A, 0, 0, 0, 0, 0}));
  EXPECT_EQ(get(Field{12, 8}, to_word(payload)), 0xABU);
}

TEST(CanPayload, SignedNumbersComeBackWithTheirSign) {
  const Field field{40, 24};
  for (const std::int64_t value :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, field.signed_max(), -field.signed_max(),
        field.not_available()}) {
    EXPECT_EQ(get_signed(field, to_word(to_payload(put_signed(field, value)))), value);
  }
}

TEST(CanPayload, AFieldLeavesItsNeighboursAlone) {
  const std::uint64_t word = put_signed(Field{16, 24}, -1);
  EXPECT_EQ(get(Field{0, 16}, word), 0U);
  EXPECT_EQ(get(Field{40, 24}, word), 0U);
}

TEST(CanPayload, ALongFieldIsNotCutShort) {
  const std::uint64_t value = (std::uint64_t{1} << 48) - 2;
  EXPECT_EQ(get(Field{16, 48}, put(Field{16, 48}, value)), value);
}

}  // namespace
}  // namespace dottrack::protocol
