#include "app/workstation/trial_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/text_of.h"

namespace dottrack::workstation {
namespace {

using testing::HasSubstr;

Trial trial_of(std::uint64_t index, Outcome outcome, int lock_tick, double probability,
               bool right) {
  Trial trial;
  trial.scene = "drive";
  trial.seed = 7;
  trial.index = index;
  trial.ticks_allowed = 3;
  trial.lock_probability = 0.25;
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
  trials[0].lock_probability = trials[1].lock_probability = 1e-9;
  trials[1].position_mm = 1.5;
  for (std::size_t i = 0; i < 3; ++i) trials[i].dots_well_lit = 4;
  trials[3].dots_well_lit = 3;
  trials[1].dots_matched = 4;
  trials[1].min_views = 2;
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
  EXPECT_EQ(able.right_in_first_tick, 1U);
  EXPECT_EQ(able.ticks_allowed, 3);
  EXPECT_EQ(able.reasons.size(), 1U);
  EXPECT_EQ(able.reasons.at({Outcome::held_back, core::Reason::held_back}), 1U);
  const TrialSummary unable = summary_of(some_trials(), false);
  EXPECT_EQ(unable.placements, 1U);
  EXPECT_EQ(unable.none, 1U);
  EXPECT_EQ(unable.reasons.at({Outcome::no_lock, core::Reason::too_few_finalists}), 1U);
}

TEST(TrialSummary, IsATableForAPerson) {
  const std::string text = summary_text(some_trials());
  for (const char* line :
       {"lockable: enough dots truly in two views +4 +2 +50\\.00 +1 +1 +0\n",
        "right in the first tick +1 +25\\.00 *\n", "right later, within 3 ticks +1 +25\\.00 *\n",
        "no lock: held_back +1 *\n", "the others +1 +0 +0\\.00 +0 +0 +1\n",
        "no lock: too_few_finalists +1\n",
        "of 3 locks, 0\\.25 wrong by the tracker's own estimate; 1 were\n"}) {
    EXPECT_THAT(text, testing::ContainsRegex(line));
  }
}

TEST(TrialSummary, IsGoodWithoutAWrongLockAndWithARightOneWhereThatCanBe) {
  std::vector<Trial> trials = some_trials();
  EXPECT_FALSE(good(trials)) << "one is wrong";
  trials.erase(trials.begin() + 2);
  EXPECT_TRUE(good(trials));
  EXPECT_FALSE(good(std::span(trials).subspan(2, 1))) << "lockable, but never a lock";
  EXPECT_TRUE(good(std::span(trials).last(1))) << "nothing to lock on to";
  EXPECT_TRUE(good({}));
  trials.back().outcome = Outcome::wrong_lock;
  trials.back().lock_tick = 0;
  EXPECT_FALSE(good(trials)) << "wrong, though not lockable";
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
  EXPECT_EQ((*back)[1].dots_matched, 4);
  EXPECT_EQ((*back)[1].min_views, 2);
  EXPECT_EQ((*back)[3].dots_well_lit, 3);
  EXPECT_EQ((*back)[1].scene, "drive");
  EXPECT_EQ((*back)[1].seed, 7U);
  EXPECT_EQ((*back)[1].lock_probability, 1e-9);
  EXPECT_EQ(split(trials_csv_header(), ',').size(), split(csv_line(some_trials()[4]), ',').size());
}

TEST(TrialFile, WhatIsNoLineIsRefusedWithItsNumber) {
  const std::string good = trials_csv_header() + csv_line(some_trials()[0]);
  const std::string rest = ",0,0,0,5,4,2,1,3,";
  ASSERT_TRUE(trials_from_csv(good + "drive,7,9" + rest + "none,residual,,,,,,,0,0\n"));
  for (const std::string& bad :
       {std::string("1,2,3\n"), "drive,7,x" + rest + "none,residual,,,,,,,0,0\n",
        "drive,7,9" + rest + "lost,residual,,,,,,,0,0\n",
        "drive,7,9" + rest + "none,tired,,,,,,,0,0\n",
        "drive,7,9" + rest + "none,residual,,,,,0.5,,0,0\n",
        "drive,7,9" + rest + "right,none,,1,1,1e-9,0.5,1,5,2\n",
        "drive,7,9" + rest + "held_back,residual,0,,,,0.5,1,5,2\n"}) {
    const auto trials = trials_from_csv(good + bad);
    ASSERT_FALSE(trials) << bad;
    EXPECT_THAT(trials.error().message, HasSubstr("line 3 "));
  }
}

TEST(TrialFile, OfAnotherHeaderIsRefused) {
  for (const char* text : {"", "index,x_m\n1,2\n", "tick,t_s,state\n"}) {
    const auto trials = trials_from_csv(text);
    ASSERT_FALSE(trials) << text;
    EXPECT_THAT(trials.error().message, testing::StartsWith("line 1: expected the header"));
  }
}

TEST(TrialFile, APlacementCountsOnce) {
  std::vector<Trial> trials = some_trials();
  EXPECT_TRUE(check_once(trials));
  trials.push_back(trials[2]);
  const auto once = check_once(trials);
  ASSERT_FALSE(once);
  EXPECT_THAT(once.error().message, testing::StartsWith("placement 2 of drive, seed 7, is there"));
  trials.back().seed = 8;
  EXPECT_TRUE(check_once(trials)) << "another run";
}

}  // namespace
}  // namespace dottrack::workstation
