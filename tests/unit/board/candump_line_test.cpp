#include "tests/board/harness/candump_line.h"

#include <gmock/gmock.h>

namespace dottrack::board {
namespace {

using testing::ElementsAre;

TEST(CandumpLine, GivesIdentifierAndBytes) {
  const auto frame = parse_candump_line("(1700000000.123456) can1 301#01A2ff");
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->id, 0x301U);
  EXPECT_FALSE(frame->extended);
  EXPECT_THAT(frame->payload(), ElementsAre(0x01, 0xA2, 0xFF));
}

TEST(CandumpLine, MayHaveNoBytes) {
  const auto frame = parse_candump_line("(1.000000) can1 7FF#");
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->length, 0);
}

TEST(CandumpLine, EverythingElseIsNoFrame) {
  for (const char* line :
       {"", "301#0102", "(1.0) can1", "(1.0) can1 301#012", "(1.0) can1 301#R", "(1.0) can1 30G#00",
        "(1.0) can1 12345678#00", "(1.0) can1 301##100", "(1.0) can1 301#000102030405060708"}) {
    EXPECT_FALSE(parse_candump_line(line)) << line;
  }
}

}  // namespace
}  // namespace dottrack::board
