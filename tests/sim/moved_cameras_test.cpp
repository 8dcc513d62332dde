// Somebody knocks against a camera during a drive: it is noticed, left out, and its model repaired
// from what was recorded.

#include <gtest/gtest.h>

#include "app/config/rig_file.h"
#include "app/workstation/calibrate/repair/camera_repair.h"
#include "app/workstation/sim_run.h"
#include "app/workstation/survey/run_file.h"
#include "host_sim/scenarios/scenario_file.h"
#include "tests/sim/moved_ticks.h"
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

TEST(MovedCameras, AKnockOfATwentiethOfADegreeIsNoticedAndRepaired) {
  const test::TemporaryFolder folder;
  host_sim::Scene scene = drive(150);
  const Eigen::Vector3d turn(0.05 * M_PI / 180.0, 0.0, 0.0);
  scene.camera_moves.push_back({kCamera, 0.1 * kKnockTick - 0.05, turn, Eigen::Vector3d::Zero()});
  const SimSummary sim = run(scene, folder.path());
  EXPECT_EQ(sim.accuracy.wrong_lock_ticks, 0U);
  EXPECT_EQ(sim.loop.allocations_in_loop, 0U);
  EXPECT_EQ(sim.loop.tracking_ticks, 150U);
  const auto first = test::moved_ticks(folder.path(), scene.cameras.size());
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

}  // namespace
}  // namespace dottrack::workstation
