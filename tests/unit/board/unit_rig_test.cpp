#include "tests/board/harness/unit_rig.h"

#include <gtest/gtest.h>

#include "app/config/rig_file.h"
#include "host_sim/scenarios/scenario_file.h"
#include "tests/board/harness/wiring.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::board {
namespace {

TEST(UnitRig, IsWhatTheUnitReads) {
  const auto scene = host_sim::load_scenario(DOTTRACK_SOURCE_DIR "/tests/board/board.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_unit_rig(*scene, folder.path()));
  const auto rig = config::load_rig(folder.path() / "rig.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  ASSERT_EQ(rig->cameras.size(), 12U);
  const auto& last = rig->unit.cameras[11];
  EXPECT_EQ(last.device, camera_id(12));
  ASSERT_TRUE(last.iris);
  EXPECT_EQ(last.iris->step_line, 11 * kLinesPerIris);
  EXPECT_DOUBLE_EQ(last.iris->opening * kIrisTravel_steps, kIrisOpening_steps);
  ASSERT_TRUE(rig->unit.trigger);
  EXPECT_EQ(rig->unit.trigger->line.line, kTriggerLine);
  EXPECT_FALSE(rig->unit.trigger->cameras_follow);
  EXPECT_TRUE(rig->unit.recording);
}

TEST(UnitRig, IdsTellPortsApart) {
  EXPECT_EQ(camera_id(1), "\\_SB_.PCI0-1:1.0-1d6b:0102");
  EXPECT_NE(camera_id(1), camera_id(11));
}

}  // namespace
}  // namespace dottrack::board
