#include "app/workstation/run_tally.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/telemetry/record_of.h"

namespace dottrack::workstation {
namespace {

using telemetry::record_with_pose;
using telemetry::record_without_pose;

using std::chrono::microseconds;
using testing::Pair;
using testing::UnorderedElementsAre;

TEST(FiguresOf, AreNearestRanks) {
  std::vector<Duration> durations;
  for (int i = 100; i >= 1; --i) durations.emplace_back(microseconds(i));
  const TimeFigures figures = figures_of(durations);
  EXPECT_EQ(figures.p50_us, 50.0);
  EXPECT_EQ(figures.p99_us, 99.0);
  EXPECT_EQ(figures.max_us, 100.0);
}

TEST(FiguresOf, OneDurationIsAllOfThem) {
  const TimeFigures figures = figures_of({Duration(1500)});
  EXPECT_EQ(figures.p50_us, 1.5);
  EXPECT_EQ(figures.p99_us, 1.5);
  EXPECT_EQ(figures.max_us, 1.5);
}

TEST(FiguresOf, NoDurationIsZero) {
  EXPECT_EQ(figures_of({}).max_us, 0.0);
}

TEST(RunTally, CountsTicksLocksAndReasons) {
  RunTally tally;
  tally.write(record_without_pose(0));
  tally.write(record_with_pose(1));
  telemetry::CycleRecord again = record_with_pose(2);
  again.result.reset_count = 3;
  again.result.pose.rms_residual_m = 0.005;
  tally.write(again);
  tally.write(record_without_pose(3));
  EXPECT_EQ(tally.ticks(), 4U);
  EXPECT_EQ(tally.tracking_ticks(), 2U);
  EXPECT_EQ(tally.first_lock_tick(), 1);
  EXPECT_DOUBLE_EQ(tally.mean_rms_residual_m(), 0.004);
  ASSERT_TRUE(tally.last_lock());
  EXPECT_EQ(tally.last_lock()->tick, 2U);
  EXPECT_THAT(tally.reasons(), UnorderedElementsAre(Pair("none", 2), Pair("too_few_regions", 2)));
}

TEST(RunTally, EveryLockAfterTheFirstIsAReacquisition) {
  RunTally tally;
  EXPECT_EQ(tally.reacquisitions(), 0U);
  telemetry::CycleRecord record = record_with_pose(0);
  record.result.reset_count = 3;
  tally.write(record);
  EXPECT_EQ(tally.reacquisitions(), 2U);
}

TEST(RunTally, ARunWithoutALockHasNone) {
  RunTally tally;
  tally.write(record_without_pose(0));
  EXPECT_EQ(tally.first_lock_tick(), -1);
  EXPECT_FALSE(tally.last_lock());
  EXPECT_EQ(tally.mean_rms_residual_m(), 0.0);
}

TEST(RunTally, HasTheTimesOfTheCycleAndOfEveryStage) {
  RunTally tally;
  telemetry::CycleRecord record;
  record.stages = {microseconds(1), microseconds(20), microseconds(3), microseconds(4),
                   microseconds(5)};
  tally.write(record);
  const auto times = tally.times();
  ASSERT_EQ(times.size(), 6U);
  EXPECT_EQ(times[0].first, "cycle");
  EXPECT_EQ(times[0].second.max_us, 33.0);
  EXPECT_EQ(times[2].first, "track");
  EXPECT_EQ(times[2].second.p50_us, 20.0);
}

}  // namespace
}  // namespace dottrack::workstation
