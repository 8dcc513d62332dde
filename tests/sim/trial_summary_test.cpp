#include "app/workstation/trial_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/text_of.h"

namespace dottrack::workstation {
namespace {

using testing::HasSubstr;
using testing::Pair;
using testing::UnorderedElementsAre;

Trial trial_of(std::uint64_t index, Outcome outcome, int lock_tick, double probability,
               bool right) {
  Trial trial;
  trial.index = index;
  trial.dots = 5;
  trial.dots_in_two_views = 4;
  trial.outcome = outcome;
  trial.lock_tick = lock_tick;
  trial.reason = lock_tick >= 0 ? core::Reason::none : core::Reason::held_back;
  trial.candidate = Candidate{probability, right};
  return trial;
}

std::vector<Trial> some_trials() {
  std::vector<Trial> trials = {trial_of(0, Outcome::right_lock, 0, 1e-9, true),
                               trial_of(1, Outcome::right_lock, 2, 1e-4, true),
                               trial_of(2, Outcome::wrong_lock, 0, 1e-9, false),
                               trial_of(3, Outcome::held_back, -1, 0.4, false)};
  trials[1].position_mm = 1.5;
  Trial& unable = trials.emplace_back();
  unable.index = 4;
  unable.dots = 5;
  unable.reason = core::Reason::too_few_finalists;
  return trials;
}

TEST(Trials, AreLockableWithFourDotsOrAllThreeInTwoViews) {
  Trial trial;
  trial.dots = 3;
  trial.dots_in_two_views = 2;
  EXPECT_FALSE(trial.lockable());
  trial.dots_in_two_views = 3;
  EXPECT_TRUE(trial.lockable());
  trial.dots = 8;
  EXPECT_FALSE(trial.lockable());
  trial.dots_in_two_views = 4;
  EXPECT_TRUE(trial.lockable());
  EXPECT_FALSE(Trial{}.lockable()) << "without a target there is nothing";
}

TEST(TrialSummary, CountsOutcomesReasonsAndTicks) {
  const TrialSummary able = summary_of(some_trials(), true);
  EXPECT_EQ(able.placements, 4U);
  EXPECT_EQ(able.right, 2U);
  EXPECT_EQ(able.wrong, 1U);
  EXPECT_EQ(able.held_back, 1U);
  EXPECT_THAT(able.right_after_ticks, UnorderedElementsAre(Pair(1, 1U), Pair(3, 1U)));
  EXPECT_THAT(able.reasons, UnorderedElementsAre(Pair("held_back", 1U)));
  const TrialSummary unable = summary_of(some_trials(), false);
  EXPECT_EQ(unable.placements, 1U);
  EXPECT_EQ(unable.none, 1U);
  EXPECT_THAT(summary_text(some_trials()), HasSubstr("50.00"));
}

TEST(Calibration, IsByDecadeAndSaysWhereThereAreTooFewToShow) {
  std::vector<Trial> trials;
  for (std::uint64_t i = 0; i < 40; ++i) {
    trials.push_back(trial_of(i, Outcome::held_back, -1, 0.2, i >= 10));
  }
  trials.push_back(trial_of(40, Outcome::right_lock, 0, 2e-3, true));
  trials.push_back(trial_of(41, Outcome::right_lock, 0, 0.0, true));
  trials.push_back(trial_of(42, Outcome::right_lock, 0, 1e-30, true));
  const auto bins = calibration_of(trials);
  EXPECT_EQ(bins[0].candidates, 40U);
  EXPECT_EQ(bins[0].wrong, 10U);
  EXPECT_NEAR(bins[0].mean_probability(), 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(bins[0].wrong_rate(), 0.25);
  EXPECT_FALSE(bins[0].too_few_to_show());
  EXPECT_EQ(bins[2].candidates, 1U);
  EXPECT_TRUE(bins[2].too_few_to_show());
  EXPECT_EQ(bins[kCalibrationDecades - 1].candidates, 2U);
  EXPECT_THAT(summary_text(trials), HasSubstr("observed / mean 1.25"));
  EXPECT_THAT(calibration_csv(trials), HasSubstr("\n0.1,1,40,0.2"));
}

TEST(Calibration, MoreWrongOnesThanExpectedAlwaysShow) {
  std::vector<Trial> trials;
  for (std::uint64_t i = 0; i < 5; ++i) {
    trials.push_back(trial_of(i, Outcome::wrong_lock, 0, 1e-7, false));
  }
  EXPECT_FALSE(calibration_of(trials)[7].too_few_to_show() &&
               calibration_of(trials)[6].too_few_to_show());
}

TEST(TrialFile, PiecesJoinedReadBackAsTheyWere) {
  std::string text;
  for (const Trial& trial : some_trials()) text += trials_csv_header() + csv_line(trial);
  const auto back = trials_from_csv(text);
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->size(), some_trials().size());
  EXPECT_EQ(summary_text(*back), summary_text(some_trials()));
  EXPECT_EQ(calibration_csv(*back), calibration_csv(some_trials()));
  EXPECT_DOUBLE_EQ((*back)[1].position_mm, 1.5);
  EXPECT_EQ(split(trials_csv_header(), ',').size(), split(csv_line(some_trials()[4]), ',').size());
}

TEST(TrialFile, WhatIsNoLineOrThereTwiceIsRefusedWithItsNumber) {
  const std::string good = trials_csv_header() + csv_line(some_trials()[0]);
  for (const std::string& bad : {std::string("1,2,3\n"), csv_line(some_trials()[0]),
                                 std::string("9,0,0,0,5,4,1,lost,none,,,,,\n")}) {
    const auto trials = trials_from_csv(good + bad);
    ASSERT_FALSE(trials) << bad;
    EXPECT_THAT(trials.error().message, HasSubstr("line 3"));
  }
}

}  // namespace
}  // namespace dottrack::workstation
