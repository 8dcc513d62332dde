// Somebody knocks against a camera during a drive: it is noticed, left out, and its model repaired
// from what was recorded.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <vector>

#include "app/config/rig_file.h"
#include "app/workstation/calibrate/repair/camera_repair.h"
#include "app/workstation/sim_run.h"
#include "app/workstation/survey/run_file.h"
#include "host_sim/scenarios/scenario_file.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::workstation {
namespace {

constexpr std::size_t kCamera = 2;
constexpr std::uint64_t kKnockTick = 60;

host_sim::Scene drive(std::uint64_t ticks) {
  return *host_sim::load_scenario(*host_sim::find_scenario("drive"), {.seed = {}, .ticks = ticks});
}

SimSummary run(const host_sim::Scene& scene, const std::filesystem::path& out) {
  host_sim::SceneRenderer renderer(scene);
  SimOptions options;
  options.out = out;
  options.pictures = false;
  auto sim = simulate(scene, renderer, options);
  if (!sim) throw std::runtime_error(sim.error().message);
  return std::move(*sim);
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

// The tick in which each camera is first reported as moved; -1: never.
std::vector<int> moved_ticks(const std::filesystem::path& out, std::size_t cameras) {
  std::ifstream in(out / "poses.csv");
  std::string line;
  std::getline(in, line);
  const auto header = fields_of(line);
  std::vector<int> first(cameras, -1);
  for (int tick = 0; std::getline(in, line); ++tick) {
    const auto fields = fields_of(line);
    for (std::size_t i = 0; i < cameras; ++i) {
      const auto column =
          std::find(header.begin(), header.end(), "cam" + std::to_string(i + 1) + "_moved") -
          header.begin();
      if (fields.at(static_cast<std::size_t>(column)) == "1" && first[i] < 0) first[i] = tick;
    }
  }
  return first;
}

TEST(MovedCameras, AKnockOfATwentiethOfADegreeIsNoticedAndRepaired) {
  const test::TemporaryFolder folder;
  host_sim::Scene scene = drive(150);
  const Eigen::Vector3d turn(0.05 * M_PI / 180.0, 0.0, 0.0);
  scene.camera_moves.push_back({kCamera, 0.1 * kKnockTick - 0.05, turn, Eigen::Vector3d::Zero()});
  const SimSummary sim = run(scene, folder.path());
  EXPECT_EQ(sim.accuracy.wrong_lock_ticks, 0U);
  EXPECT_EQ(sim.loop.allocations_in_loop, 0U);
  EXPECT_EQ(sim.loop.tracking_ticks, 150U);
  const auto first = moved_ticks(folder.path(), scene.cameras.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (i == kCamera) continue;
    EXPECT_EQ(first[i], -1) << i;
  }
  EXPECT_GE(first[kCamera], int(kKnockTick));
  EXPECT_LE(first[kCamera], int(kKnockTick) + 60);

  const auto config = config::load_rig(folder.path() / "rig/rig.toml");
  ASSERT_TRUE(config);
  const auto ticks = read_run(folder.path(), *config);
  ASSERT_TRUE(ticks) << ticks.error().message;
  const auto repair = calibrate::repair_camera(config->rig, kCamera, *ticks, std::nullopt);
  ASSERT_TRUE(repair) << repair.error().message;
  EXPECT_GT(repair->views, 100U);
  EXPECT_GT(repair->rms_before_px, 1.5 * repair->rms_px);
}

TEST(MovedCameras, NobodyIsSuspectedWithoutAReason) {
  for (const char* scenario : {"drive", "people", "camera_faults"}) {
    const test::TemporaryFolder folder;
    const auto scene =
        *host_sim::load_scenario(*host_sim::find_scenario(scenario), {.seed = {}, .ticks = 120});
    const SimSummary sim = run(scene, folder.path());
    EXPECT_GE(sim.loop.tracking_ticks, 100U) << scenario;
    for (const int tick : moved_ticks(folder.path(), scene.cameras.size())) EXPECT_EQ(tick, -1);
  }
}

}  // namespace
}  // namespace dottrack::workstation
