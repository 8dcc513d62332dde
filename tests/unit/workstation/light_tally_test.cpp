#include "app/workstation/light_tally.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dottrack::workstation {
namespace {

using testing::ElementsAre;

constexpr std::size_t kCameras = 8;
constexpr int kRight_dn = 191;

LightScript script(std::vector<double> changes_s = {}) {
  LightScript script{.cameras = {}, .frame_rate_hz = 10.0, .changes_s = std::move(changes_s)};
  for (std::size_t i = 0; i < kCameras; ++i)
    script.cameras.push_back("cam" + std::to_string(i + 1));
  return script;
}

// A pose from every camera, whose dots are as bright as this.
telemetry::CycleRecord lit(int peak_dn) {
  telemetry::CycleRecord record;
  record.result.has_pose = true;
  for (std::size_t i = 0; i < kCameras; ++i) {
    record.result.cameras[i].used = true;
    record.light[i].peak_dn = peak_dn;
  }
  return record;
}

void write(LightTally& tally, int ticks, const telemetry::CycleRecord& record) {
  for (int i = 0; i < ticks; ++i) tally.write(record);
}

TEST(LightTally, CountsTicksWithoutAPoseAfterTheFirstLockAndTheirLongestRow) {
  LightTally tally(script());
  const telemetry::CycleRecord none;
  write(tally, 5, none);
  write(tally, 1, lit(kRight_dn));
  write(tally, 2, none);
  write(tally, 1, lit(kRight_dn));
  write(tally, 3, none);
  const LightFigures figures = tally.figures();
  EXPECT_EQ(figures.ticks, 12U);
  EXPECT_EQ(figures.without_pose, 5U);
  EXPECT_EQ(figures.longest_gap, 3U);
}

TEST(LightTally, CountsPicturesWithSaturatedDotsThoughNotAGlint) {
  LightTally tally(script());
  telemetry::CycleRecord record = lit(kRight_dn);
  record.light[0].saturated_px = 2;
  record.light[1].saturated_px = 3;
  record.light[2].saturated_px = 400;
  record.light[7].saturated_px = 400;
  record.result.cameras[7].used = false;
  record.result.cameras[5].bloomed = 4;
  write(tally, 3, record);
  EXPECT_EQ(tally.figures().saturated, 3U * 2U);
  EXPECT_EQ(tally.figures().bloomed_views, 3U * 4U);
}

TEST(LightTally, NamesAnIrisOnceAndWhen) {
  LightTally tally(script());
  telemetry::CycleRecord record = lit(kRight_dn);
  write(tally, 12, record);
  record.unhealthy_irises.insert(4);
  write(tally, 3, record);
  record.unhealthy_irises.insert(0);
  record.unhealthy_irises.insert(kCameras);  // no camera of the run
  write(tally, 3, record);
  EXPECT_THAT(tally.figures().faults, ElementsAre("cam5 at 1.2 s", "cam1 at 1.5 s"));
}

TEST(LightTally, SettledIsTheLongestTimeAfterAChange) {
  LightTally tally(script({5.0, 2.0}));
  write(tally, 20, lit(kRight_dn));
  write(tally, 7, lit(60));  // from 2.0 s
  write(tally, 23, lit(kRight_dn));
  write(tally, 3, lit(250));  // from 5.0 s
  write(tally, 20, lit(kRight_dn));
  EXPECT_DOUBLE_EQ(tally.figures().settled_after_s, 0.7);
}

TEST(LightTally, WhatIsRightForAMomentOnlyIsNotSettled) {
  LightTally tally(script());
  for (int i = 0; i < 10; ++i) {
    write(tally, 3, lit(kRight_dn));  // held for 0.3 s
    write(tally, 1, lit(60));
  }
  EXPECT_EQ(tally.figures().settled_after_s, -1.0);
  write(tally, 4, lit(kRight_dn));
  EXPECT_DOUBLE_EQ(tally.figures().settled_after_s, 4.0);
}

TEST(LightTally, OneCameraInEightMayBeOffButNoneSaturated) {
  telemetry::CycleRecord one_off = lit(kRight_dn);
  one_off.light[3].peak_dn = 30;
  LightTally one(script());
  write(one, 10, one_off);
  EXPECT_EQ(one.figures().settled_after_s, 0.0);

  telemetry::CycleRecord two_off = one_off;
  two_off.light[4].peak_dn = 30;
  LightTally two(script());
  write(two, 10, two_off);
  EXPECT_EQ(two.figures().settled_after_s, -1.0);

  telemetry::CycleRecord saturated = lit(kRight_dn);
  saturated.light[6].saturated_px = 3;
  LightTally full(script());
  write(full, 10, saturated);
  EXPECT_EQ(full.figures().settled_after_s, -1.0);
}

TEST(LightTally, WithinAThirdOfTheTargetIsRight) {
  for (const int peak_dn : {148, 191, 247}) {
    LightTally tally(script());
    write(tally, 10, lit(peak_dn));
    EXPECT_EQ(tally.figures().settled_after_s, 0.0) << peak_dn;
  }
  for (const int peak_dn : {146, 249}) {
    LightTally tally(script());
    write(tally, 10, lit(peak_dn));
    EXPECT_EQ(tally.figures().settled_after_s, -1.0) << peak_dn;
  }
}

// Nothing can be told of a change that another one, or the end, follows within what has to be held.
TEST(LightTally, AChangeWithNoTimeToSettleDoesNotCount) {
  LightTally tally(script({3.0, 3.3}));
  write(tally, 30, lit(kRight_dn));
  write(tally, 3, lit(60));  // 3.0 s to 3.3 s
  write(tally, 2, lit(60));  // from 3.3 s
  write(tally, 10, lit(kRight_dn));
  EXPECT_DOUBLE_EQ(tally.figures().settled_after_s, 0.2);
  LightTally ends(script({3.0}));
  write(ends, 30, lit(kRight_dn));
  write(ends, 4, lit(60));
  EXPECT_EQ(ends.figures().settled_after_s, 0.0);
}

}  // namespace
}  // namespace dottrack::workstation
