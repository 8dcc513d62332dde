#include "tests/board/harness/verdict.h"

#include <gmock/gmock.h>

namespace dottrack::board {
namespace {

using testing::HasSubstr;

TEST(Verdict, HoldsWhenEveryFindingDoes) {
  Verdict verdict;
  verdict.add({"one", true, "1"});
  EXPECT_TRUE(verdict.all_hold());
  verdict.add({"two", false, "2"});
  verdict.add({"three", true, "3"});
  EXPECT_FALSE(verdict.all_hold());
}

TEST(Verdict, NothingFoundIsNothingHeld) {
  EXPECT_FALSE(Verdict().all_hold());
}

TEST(Verdict, JsonEscapesWhatAGuestMaySay) {
  Verdict verdict;
  verdict.add({"shell", false, "says \"no\"\nC:\\"});
  EXPECT_THAT(verdict.json(), HasSubstr(R"("figures": "says \"no\"\u000aC:\\")"));
  EXPECT_THAT(verdict.json(), HasSubstr("\"all_hold\": false"));
}

TEST(Verdict, ALineSaysWhetherItHolds) {
  EXPECT_THAT(table_line({"poses", true, "100"}), HasSubstr("ok"));
  EXPECT_THAT(table_line({"poses", false, "3"}), HasSubstr("FAILED"));
}

}  // namespace
}  // namespace dottrack::board
