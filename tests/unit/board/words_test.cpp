#include <gtest/gtest.h>

#include "tests/board/harness/fault_steps.h"

namespace dottrack::board {
namespace {

TEST(HoldsWord, TellsNumberedNamesApart) {
  EXPECT_TRUE(holds_word("tracking (without cam1, cam11)", "cam1"));
  EXPECT_TRUE(holds_word("cam1", "cam1"));
  EXPECT_FALSE(holds_word("tracking (without cam11)", "cam1"));
  EXPECT_FALSE(holds_word("webcam1", "cam1"));
  EXPECT_TRUE(holds_word("cam11, cam1", "cam1"));
}

TEST(HoldsWord, WordsMayHoldSpaces) {
  EXPECT_TRUE(holds_word("not recording (2 ticks lost)", "ticks lost"));
  EXPECT_FALSE(holds_word("recording", "not recording"));
}

}  // namespace
}  // namespace dottrack::board
