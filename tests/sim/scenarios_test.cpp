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
        // name, ticks, at least tracked, position RMS and worst (mm), attitude worst (degrees):
        // twice what was measured
        Case{"drive", 30, 30, 0.6, 1.2, 0.08}, Case{"clutter", 30, 30, 0.5, 0.8, 0.06},
        Case{"people", 20, 20, 0.5, 0.7, 0.06}, Case{"lights", 70, 70, 1.0, 3.0, 0.2},
        Case{"sun_blooming", 40, 40, 0.5, 1.0, 0.06}, Case{"ramp", 60, 60, 0.6, 1.2, 0.06},
        Case{"crane_lines", 30, 30, 0.3, 0.5, 0.03}, Case{"survey_grid", 60, 60, 0.6, 1.2, 0.09},
        Case{"occlusion", 100, 98, 1.0, 2.2, 0.2}, Case{"kidnap", 60, 58, 0.6, 1.0, 0.09},
        Case{"two_views", 10, 10, 1.3, 1.7, 0.14}, Case{"camera_faults", 60, 58, 0.9, 2.0, 0.25},
        Case{"three_dots", 30, 29, 1.1, 2.4, 0.25}, Case{"eight_dots", 30, 30, 0.6, 1.1, 0.08}),
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
