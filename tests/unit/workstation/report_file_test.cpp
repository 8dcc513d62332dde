#include "app/workstation/report_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/telemetry/record_of.h"
#include "tests/unit/workstation/json_check.h"

namespace dottrack::workstation {
namespace {

using telemetry::record_with_pose;
using telemetry::record_without_pose;

config::RigConfig rig() {
  config::RigConfig config;
  config.name = "a \"quoted\"\tname \\ with a tab";
  config.cameras = {{"left", {}}, {"right", {}}};
  return config;
}

TEST(JsonCheck, TellsJsonFromOtherTexts) {
  for (const char* good : {"{}", "[1, -2.5e-3, \"a\\\"b\", null]", "{\"a\": {\"b\": [true]}}"}) {
    EXPECT_TRUE(is_json(good)) << good;
  }
  for (const char* bad : {"", "{", "{\"a\": nan}", "{\"a\" 1}", "{\"a\": 1,}", "{} {}", "[1 2]"}) {
    EXPECT_FALSE(is_json(bad)) << bad;
  }
}

TEST(Report, IsJsonWithTheKeysThatOthersRelyOn) {
  RunTally tally;
  tally.write(record_with_pose(0));
  const std::string report = report_json(rig(), tally, {});
  ASSERT_TRUE(is_json(report)) << report;
  for (const char* key :
       {"ticks", "tracking_ticks", "first_lock_tick", "reacquisitions", "deadline_misses",
        "allocations_in_loop", "bad_frames", "missing_frames", "memory_bytes", "build_type"}) {
    EXPECT_TRUE(json_member(report, key)) << key;
  }
  for (const char* key :
       {"cycle_us", "capture_us", "track_us", "broadcast_us", "expose_us", "record_us"}) {
    const auto times = json_member(report, key);
    ASSERT_TRUE(times) << key;
    for (const char* figure : {"p50", "p99", "max"}) EXPECT_TRUE(json_member(*times, figure));
  }
}

TEST(Report, SaysWhatTheRunWas) {
  RunTally tally;
  tally.write(record_without_pose(0));
  telemetry::CycleRecord record = record_with_pose(1);
  record.counters.missing_frames[1] = 17;
  record.counters.deadline_misses = 4;
  tally.write(record);
  RunFacts facts;
  facts.allocations_in_loop = 3;
  facts.allocation_trap_complete = true;
  facts.bad_frames = 2;
  facts.tracker_bytes = 1000;
  const std::string report = report_json(rig(), tally, facts);
  EXPECT_EQ(json_member(report, "ticks"), "2");
  EXPECT_EQ(json_member(report, "tracking_ticks"), "1");
  EXPECT_EQ(json_member(report, "first_lock_tick"), "1");
  EXPECT_EQ(json_member(report, "deadline_misses"), "4");
  EXPECT_EQ(json_member(report, "allocations_in_loop"), "3");
  EXPECT_EQ(json_member(report, "allocation_trap_complete"), "true");
  EXPECT_EQ(json_member(report, "bad_frames"), "2");
  EXPECT_EQ(json_member(json_member(report, "missing_frames").value_or(""), "right"), "17");
  EXPECT_EQ(json_member(json_member(report, "memory_bytes").value_or(""), "tracker"), "1000");
  EXPECT_EQ(json_member(json_member(report, "reasons").value_or(""), "too_few_regions"), "1");
}

TEST(Report, OfARunWithoutALockIsJsonToo) {
  RunTally tally;
  tally.write(record_without_pose(0));
  const std::string report = report_json(rig(), tally, {});
  EXPECT_TRUE(is_json(report)) << report;
  EXPECT_EQ(json_member(report, "first_lock_tick"), "-1");
  EXPECT_EQ(json_member(report, "last_lock"), "null");
}

}  // namespace
}  // namespace dottrack::workstation
