#include "tests/board/harness/time_map.h"

#include <gtest/gtest.h>

namespace dottrack::board {
namespace {

using std::chrono::milliseconds;

Time at(int ms) {
  return Time(milliseconds(ms));
}

TEST(TimeMap, IsUnknownBeforeTheFirstAnswer) {
  EXPECT_FALSE(TimeMap().known());
}

TEST(TimeMap, AnAnswerLiesBetweenTheQuestionAndItsArrival) {
  TimeMap map;
  map.add(at(10'000), at(500), at(10'100));
  ASSERT_TRUE(map.known());
  EXPECT_EQ(map.to_host(at(500)), at(10'050));
  EXPECT_EQ(map.uncertainty(), milliseconds(50));
}

TEST(TimeMap, MoreAnswersNarrowIt) {
  TimeMap map;
  map.add(at(10'000), at(500), at(10'100));    // 9500 to 9600
  map.add(at(11'000), at(1'440), at(11'300));  // 9560 to 9860
  EXPECT_EQ(map.uncertainty(), milliseconds(20));
  EXPECT_EQ(map.to_host(at(0)), at(9'580));
}

TEST(TimeMap, AnswersThatContradictEachOtherGiveNone) {
  TimeMap map;
  map.add(at(10'000), at(500), at(10'100));
  map.add(at(20'000), at(11'000), at(20'100));
  EXPECT_FALSE(map.known());
}

}  // namespace
}  // namespace dottrack::board
