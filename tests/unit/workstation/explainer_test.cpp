#include "app/workstation/explainer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "app/workstation/reason_words.h"
#include "tests/unit/telemetry/record_of.h"

namespace dottrack::workstation {
namespace {

using core::Reason;
using telemetry::CycleRecord;
using testing::HasSubstr;
using testing::Not;

constexpr int kReasons = 16;

class Explain : public testing::Test {
 protected:
  static config::RigConfig rig() {
    config::RigConfig config;
    config.cameras = {{"left", {}}, {"right", {}}, {"door", {}}};
    config.rig.target.dots.resize(5);
    return config;
  }
  static CycleRecord record_of(std::uint64_t tick, Reason reason) {
    CycleRecord record;
    record.result.tick = tick;
    record.result.reason = reason;
    core::CameraTick& left = record.result.cameras[0];
    left.delivered = true;
    left.components = 131;
    left.rejected_size = 97;
    left.rejected_shape = 21;
    left.regions = 13;
    left.rejected_sight = 4;
    left.sightings = 9;
    record.result.cameras[1].stale = true;
    return record;
  }

  std::string said_;
  Explainer explainer_{rig(), [this](const std::string& text) { said_ += text; }};
};

TEST_F(Explain, HasASentenceOfItsOwnAndAdviceForEveryReason) {
  std::set<std::string_view> sentences;
  for (int i = 1; i < kReasons; ++i) {
    const auto reason = static_cast<Reason>(i);
    const ReasonWords words = words_for(reason);
    EXPECT_TRUE(words.why.ends_with(".")) << to_string(reason);
    EXPECT_TRUE(words.remedy.ends_with(".")) << to_string(reason);
    sentences.insert(words.why);
    said_.clear();
    explainer_.write(record_of(static_cast<std::uint64_t>(i), reason));
    EXPECT_THAT(said_, HasSubstr(to_string(reason)));
    EXPECT_THAT(said_, HasSubstr(words.why));
    EXPECT_THAT(said_, HasSubstr(words.remedy));
  }
  EXPECT_EQ(sentences.size(), kReasons - 1U);
  EXPECT_EQ(words_for(Reason::none).why, "");
}

TEST_F(Explain, CountsWhatEachGateLeftInEveryCamera) {
  explainer_.write(record_of(3, Reason::too_few_regions));
  EXPECT_THAT(said_, testing::StartsWith("tick 3: no pose: too_few_regions, while acquiring\n"));
  EXPECT_THAT(said_, testing::ContainsRegex("left +131 +97 +21 +13 +4 +- +9"));
  EXPECT_THAT(said_, testing::ContainsRegex("right +the same picture again"));
  EXPECT_THAT(said_, testing::ContainsRegex("door +no image"));
  EXPECT_THAT(said_, Not(HasSubstr("pairs of regions")));
}

TEST_F(Explain, CountsWhatTrackingRefusedOfTheDotsWindows) {
  CycleRecord record = record_of(3, Reason::too_few_dots);
  record.result.state = core::State::tracking;
  record.result.cameras[0] = {.delivered = true, .regions = 6, .rejected_ellipse = 4};
  explainer_.write(record);
  EXPECT_THAT(said_, HasSubstr("too_few_dots, while tracking\n"));
  EXPECT_THAT(said_, testing::ContainsRegex("left +- +- +- +6 +- +4 +-"));
}

TEST_F(Explain, IsShort) {
  CycleRecord record = record_of(0, Reason::held_back);
  record.result.acquisition.pairs_tested = 5000;
  record.result.acquisition.rejected_miss = 4000;
  record.result.acquisition.dots_matched = 4;
  explainer_.write(record);
  EXPECT_LE(std::count(said_.begin(), said_.end(), '\n'), 12);
  said_.clear();
  explainer_.write(record_of(1, Reason::residual));
  explainer_.write(record_of(2, Reason::held_back));
  EXPECT_THAT(said_, Not(HasSubstr(words_for(Reason::held_back).why))) << "once is enough";
}

TEST_F(Explain, SaysHowFarASearchCame) {
  CycleRecord record = record_of(0, Reason::held_back);
  record.result.acquisition.pairs_tested = 5000;
  record.result.acquisition.rejected_behind = 17;
  record.result.acquisition.rejected_miss = 4000;
  record.result.acquisition.finalists = 42;
  record.result.acquisition.ticks = 3;
  record.result.acquisition.min_views = 2;
  record.result.acquisition.dots_matched = 4;
  record.result.acquisition.false_lock_probability = 3e-4;
  explainer_.write(record);
  EXPECT_THAT(said_, HasSubstr("5000 tested"));
  EXPECT_THAT(said_, HasSubstr("places where dots may be: 42"));
  EXPECT_THAT(said_, HasSubstr("    refused: 17 behind a camera, 4000 rays miss\n"));
  EXPECT_THAT(said_, HasSubstr("3 ticks so far"));
  EXPECT_THAT(said_, HasSubstr("4 of 5 dots"));
  EXPECT_THAT(said_, HasSubstr("3.0e-04 (a lock: 1e-06 or less)"));
}

TEST_F(Explain, TicksForTheSameReasonAreFoldedAndThoseWithAPosePassedOver) {
  for (std::uint64_t tick = 0; tick < 9; ++tick) {
    CycleRecord record = record_of(tick, Reason::no_matching_subset);
    record.result.has_pose = tick == 5;
    record.result.cameras[0].regions += static_cast<std::uint32_t>(tick);  // noise
    explainer_.write(record);
  }
  for (std::uint64_t tick = 9; tick < 12; ++tick) {
    CycleRecord record = record_of(tick, Reason::held_back);
    record.result.acquisition.false_lock_probability = tick == 10 ? 3e-5 : 0.1;
    explainer_.write(record);
  }
  CycleRecord fails = record_of(12, Reason::held_back);
  fails.result.cameras[0].delivered = false;
  explainer_.write(fails);
  explainer_.write(record_of(13, Reason::held_back));
  explainer_.write(record_of(14, Reason::held_back));
  explainer_.finish();
  for (const char* line :
       {"tick 0: no pose", "ticks 1 to 4: no_matching_subset still\n", "tick 6: no pose",
        "ticks 7 to 8: no_matching_subset still\n", "tick 9: no pose",
        "ticks 10 to 11: held_back still; best match of them by chance with probability 3.0e-05\n",
        "tick 12: no pose", "tick 13: no pose", "tick 14: held_back still\n"}) {
    EXPECT_THAT(said_, HasSubstr(line));
  }
  EXPECT_THAT(said_, Not(HasSubstr("tick 5")));
}

}  // namespace
}  // namespace dottrack::workstation
