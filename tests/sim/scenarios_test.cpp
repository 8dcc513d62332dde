// Every built-in scenario, as far as its point: the tracker's poses against the truth. Each margin
// is about twice what was measured. Wrong locks: none, anywhere.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "app/workstation/sim_run.h"
#include "app/workstation/trial_summary.h"
#include "app/workstation/trials.h"
#include "host_sim/scenarios/scenario_file.h"
#include "tests/sim/moved_ticks.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::workstation {
namespace {

struct Case {
  const char* scenario;
  std::uint64_t ticks;
  std::uint64_t least_tracked;  // ticks with a pose
  double position_rms_mm;
  double position_max_mm;
  double attitude_max_deg;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.scenario;
}

host_sim::Scene load(const std::string& name, std::uint64_t ticks) {
  const auto file = host_sim::find_scenario(name);
  if (!file) throw std::runtime_error(file.error().message);
  auto scene = host_sim::load_scenario(*file, {.seed = {}, .ticks = ticks});
  if (!scene) throw std::runtime_error(scene.error().message);
  return std::move(*scene);
}

SimSummary run(const std::string& name, std::uint64_t ticks, const std::filesystem::path& out) {
  const host_sim::Scene scene = load(name, ticks);
  host_sim::SceneRenderer renderer(scene);
  SimOptions options;
  options.out = out;
  options.pictures = false;
  auto sim = simulate(scene, renderer, options);
  if (!sim) throw std::runtime_error(sim.error().message);
  return std::move(*sim);
}

class Scenarios : public testing::TestWithParam<Case> {};

TEST_P(Scenarios, AreTrackedAndNeverWrongly) {
  const Case& expected = GetParam();
  const test::TemporaryFolder folder;
  const SimSummary sim = run(expected.scenario, expected.ticks, folder.path() / "out");
  EXPECT_EQ(sim.accuracy.wrong_lock_ticks, 0U);
  EXPECT_EQ(sim.loop.ticks, expected.ticks);
  EXPECT_GE(sim.loop.tracking_ticks, expected.least_tracked);
  EXPECT_LE(sim.accuracy.position_rms_mm, expected.position_rms_mm);
  EXPECT_LE(sim.accuracy.position_max_mm, expected.position_max_mm);
  EXPECT_LE(sim.accuracy.attitude_max_deg, expected.attitude_max_deg);
  EXPECT_EQ(sim.loop.allocations_in_loop, 0U);
  EXPECT_THAT(test::moved_ticks(folder.path() / "out", load(expected.scenario, 1).cameras.size()),
              testing::Each(-1));
}

INSTANTIATE_TEST_SUITE_P(
    BuiltIn, Scenarios,
    testing::Values(
        // name, ticks, at least tracked, position RMS and worst (mm), attitude worst (degrees)
        Case{"drive", 30, 30, 3.5, 8.0, 0.7}, Case{"clutter", 30, 30, 3.0, 6.0, 0.5},
        Case{"people", 20, 20, 3.5, 7.0, 0.6}, Case{"lights", 70, 70, 4.0, 16.0, 1.0},
        Case{"sun_blooming", 40, 34, 7.0, 17.0, 1.4}, Case{"ramp", 60, 60, 2.0, 4.0, 0.4},
        Case{"crane_lines", 30, 30, 1.2, 2.5, 0.2}, Case{"survey_grid", 60, 36, 2.5, 5.0, 0.5},
        Case{"occlusion", 100, 95, 8.0, 48.0, 5.0}, Case{"kidnap", 60, 54, 2.0, 4.0, 0.4},
        Case{"two_views", 10, 10, 2.5, 4.0, 0.3}, Case{"camera_faults", 60, 57, 4.0, 12.0, 0.9},
        Case{"three_dots", 30, 29, 6.0, 14.0, 1.5}, Case{"eight_dots", 30, 30, 5.0, 14.0, 1.2}),
    [](const auto& scenario) { return std::string(scenario.param.scenario); });

// Nobody there but look-alikes, and one who walks about.
TEST(EmptyScenario, NeverGivesAPose) {
  const test::TemporaryFolder folder;
  const SimSummary sim = run("empty", 25, folder.path() / "out");
  EXPECT_EQ(sim.loop.tracking_ticks, 0U);
  EXPECT_EQ(sim.accuracy.wrong_lock_ticks, 0U);
}

// Anywhere in the hall, in any light, among random clutter; measured: 59 of 60 right.
TEST(RandomPlacements, AreFoundAndNeverTakenForAnother) {
  const test::TemporaryFolder folder;
  const host_sim::Scene scene = load("drive", 1);
  host_sim::SceneRenderer renderer(scene);
  const auto run =
      run_trials(scene, renderer, {.out = folder.path() / "out", .count = 12, .go_on = {}});
  ASSERT_TRUE(run) << run.error().message;
  const TrialSummary able = summary_of(run->trials, true);
  EXPECT_EQ(able.wrong + summary_of(run->trials, false).wrong, 0U);
  EXPECT_GE(able.placements, 10U);
  EXPECT_GE(able.right + 2, able.placements);
}

}  // namespace
}  // namespace dottrack::workstation
