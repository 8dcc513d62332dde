#include "host_sim/scenarios/scenario_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "host_sim/scenarios/body_scenes.h"
#include "host_sim/scenarios/visibility.h"
#include "host_sim/world/portable_math.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::host_sim {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kHead = "[scenario]\nname = \"s\"\nticks = 50\n";
const std::string kStand = "[motion]\nkind = \"stand\"\nat = [1.0, 0.5]\n";

Scene scene_of(const std::string& text, const ScenarioOverrides& overrides = {}) {
  auto scene = parse_scenario(text, "s.toml", overrides);
  if (!scene) throw std::runtime_error(scene.error().message);
  return std::move(*scene);
}

TEST(ScenarioFile, TheSmallestOneIsTheHallWithTwelveCameras) {
  const Scene scene = scene_of(kHead + kStand);
  EXPECT_EQ(scene.cameras.size(), 12U);
  EXPECT_EQ(scene.cameras[0].name, "cam1");
  EXPECT_EQ(scene.cameras[11].camera.width_px(), 640);
  EXPECT_EQ(scene.length_m, 22.0);
  EXPECT_EQ(scene.target.size(), 5U);
  EXPECT_EQ(scene.ticks, 50U);
  EXPECT_EQ(scene.world.light.level("sun", 1.0), 0.0);
  EXPECT_EQ(scene.world.light.level("fluorescent_west", 1.0), 1.0);
  ASSERT_TRUE(truth(scene, 3.0));
  EXPECT_NEAR(truth(scene, 3.0)->position_m.x(), 1.0, 1e-3);
  EXPECT_FALSE(scene.world.hall.parts.empty());
}

TEST(ScenarioFile, OverridesCountMoreThanTheFile) {
  const Scene scene = scene_of(kHead + kStand, {.seed = 77, .ticks = 5});
  EXPECT_EQ(scene.seed, 77U);
  EXPECT_EQ(scene.ticks, 5U);
  const auto none = parse_scenario(kHead + kStand, "s.toml", {.seed = {}, .ticks = 0});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "ticks is 0; expected a whole number from 1 to 1000000");
}

TEST(ScenarioFile, NearlyEveryPlaceOfTheSandboxIsSeenThreeTimes) {
  const Scene scene = scene_of(kHead + kStand);
  int places = 0;
  int three = 0;
  for (double x = -10.5; x <= 10.5; x += 0.5) {
    for (double y = -4.0; y <= 4.0; y += 0.5, ++places) {
      const int cameras = cameras_on(scene.cameras, {x, y, 0.5}, 8.0);
      EXPECT_GE(cameras, 1) << x << " " << y;
      if (cameras >= 3) ++three;
    }
  }
  EXPECT_GT(three, 0.95 * places);
}

TEST(ScenarioFile, TheSeedMakesTheCamerasAndTheSameSeedTheSame) {
  const Scene a = scene_of(kHead + kStand, {.seed = 5, .ticks = {}});
  const Scene b = scene_of(kHead + kStand, {.seed = 5, .ticks = {}});
  const Scene c = scene_of(kHead + kStand, {.seed = 6, .ticks = {}});
  EXPECT_EQ(a.cameras[3].camera.centre_m(), b.cameras[3].camera.centre_m());
  EXPECT_NE(a.cameras[3].camera.centre_m(), c.cameras[3].camera.centre_m());
}

TEST(ScenarioFile, EveryMotionIsThere) {
  const auto at = [](const std::string& motion, double time_s) {
    const auto pose = truth(scene_of(kHead + "[motion]\n" + motion), time_s);
    return pose ? pose->position_m : Eigen::Vector3d(99.0, 99.0, 99.0);
  };
  const std::string way = "way_points = [[-2, 0], [2, 0], [2, 2]]\nspeed_m_s = 0.5\n";
  EXPECT_NEAR(at("kind = \"drive\"\n" + way, 0.0).x(), -2.0, 0.03);
  EXPECT_GT((at("kind = \"drive\"\n" + way, 2.0) - at("kind = \"drive\"\n" + way, 0.0)).norm(),
            0.8);
  const std::string kidnap = "kind = \"kidnap\"\nplaces = [[0, -3, 0, 0], [2, 3, 1, 90]]\n";
  EXPECT_NEAR(at(kidnap, 1.97).x(), -3.0, 1e-3);
  EXPECT_NEAR(at(kidnap, 2.0).x(), 3.0, 1e-3);
  EXPECT_NEAR(at(kidnap, 1.99).x(), 3.0, 1e-3) << "before the exposure at 2 s begins";
  const std::string leave = "kind = \"leave_and_return\"\n" + way + "gone_s = 1\nback_s = 3\n";
  EXPECT_LT(at(leave, 0.9).x(), 90.0);
  EXPECT_EQ(at(leave, 2.0).x(), 99.0);
  EXPECT_LT(at(leave, 3.0).x(), 90.0);
  const std::string grid = "kind = \"survey_grid\"\ncolumns = 3\nrows = 2\ndwell_s = 1\n";
  EXPECT_NEAR(at(grid, 0.5).x(), -9.5, 1e-3);
  EXPECT_NEAR(at(grid, 2.5).x(), 9.5, 1e-3);
  EXPECT_NEAR(at(grid, 5.5).y(), 3.0, 1e-3);
}

TEST(ScenarioFile, TheRampIsClimbedHalfWay) {
  const Scene scene = scene_of(kHead +
                               "[motion]\nkind = \"ramp\"\nfoot = [0, 0]\nheading_deg = 0\n"
                               "slope_deg = 25\nlength_m = 6\nspeed_m_s = 0.2\n");
  const auto pose = truth(scene, 60.0);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->rotation(2, 0), sine(radians(25.0)), 0.01);
  EXPECT_NEAR(pose->position_m.x(), 3.0 * cosine(radians(25.0)), 0.1);
}

TEST(ScenarioFile, TheHangingTargetMovesAlongItsLines) {
  const Scene scene = scene_of(kHead +
                               "[vehicle]\nkind = \"hanging\"\n[motion]\nkind = \"crane_lines\"\n"
                               "speed_m_s = 1.0\nvibration_m = 0.002\n"
                               "lines = [[-4, 1, 1, 4, 1, 1]]\n");
  const auto pose = truth(scene, 4.0);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->position_m.x(), 0.0, 0.06);
  EXPECT_NEAR(pose->position_m.y(), 1.0, 0.005);
}

TEST(ScenarioFile, WithoutAVehicleThereIsNoTruth) {
  const Scene scene = scene_of(kHead + "[vehicle]\nkind = \"none\"\ndots = 4\n");
  EXPECT_FALSE(scene.vehicle);
  EXPECT_FALSE(truth(scene, 0.0));
  EXPECT_EQ(scene.target.size(), 4U);
}

TEST(ScenarioFile, TheHardwareIsAsTheFileSays) {
  const Scene scene =
      scene_of(kHead + kStand +
               "[grabber]\nlatency_ms = 20\njitter_ms = 3\ndrop_share = 0.25\n"
               "[[camera_fault]]\ncamera = \"cam2\"\nkind = \"torn\"\nfrom_s = 1\nto_s = 2\n"
               "[iris]\nopening = 0.5\nbacklash = 0.1\n[can]\nbit_rate = 250000\nload = 0.5\n"
               "[[can_outage]]\nfrom_s = 3\nto_s = 4\n"
               "[sensor]\nshutter = \"rolling\"\nline_time_us = 40\nexposure_ms = 2\ngain = 3\n"
               "[[light_change]]\ngroup = \"sun\"\nat_s = 2\nto = 0.8\nover_s = 2\n");
  EXPECT_DOUBLE_EQ(scene.grabber.latency_s, 0.020);
  EXPECT_DOUBLE_EQ(scene.grabber.jitter_s, 0.003);
  EXPECT_EQ(scene.grabber.drop_share, 0.25);
  ASSERT_EQ(scene.camera_faults.size(), 1U);
  EXPECT_EQ(scene.camera_faults[0].camera, 1U);
  EXPECT_EQ(scene.camera_faults[0].kind, CameraFaultKind::torn);
  EXPECT_EQ(scene.iris.opening, 0.5);
  EXPECT_EQ(scene.can.bit_rate, 250000.0);
  ASSERT_EQ(scene.can.bus_off.size(), 1U);
  EXPECT_DOUBLE_EQ(scene.cameras[5].sensor.line_time_s, 40e-6);
  EXPECT_DOUBLE_EQ(scene.cameras[5].exposure_s, 0.002);
  EXPECT_EQ(scene.cameras[5].gain, 3.0);
  EXPECT_NEAR(scene.world.light.level("sun", 3.0), 0.4, 1e-12);
}

TEST(ScenarioFile, ACoverHidesADotFromTheCameras) {
  const Scene scene =
      scene_of(kHead + kStand +
               "[hall]\nrocks = 0\nlook_alikes = 0\nlander = false\n"
               "[[cover]]\nover_m = [0, 0]\nsize_m = [1.9, 2.0]\nfrom_s = 1\nto_s = "
               "2\n");
  const Hall hall(scene.world.hall, scene.world.lamps);
  const BodyScenes bodies(scene.world.bodies);
  const auto views = [&](double time_s) {
    return views_of_dots(scene.cameras, scene.target, *truth(scene, time_s), hall, bodies.moving(),
                         time_s);
  };
  EXPECT_GE(dots_in_two_views(views(0.5)), 4);
  EXPECT_EQ(dots_in_two_views(views(1.5)), 0);
}

struct Mistake {
  std::string name;
  std::string text;  // after the head of three lines
  std::string message;
};
void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

class ScenarioFileRefuses : public testing::TestWithParam<Mistake> {};

TEST_P(ScenarioFileRefuses, WithOneLine) {
  const auto scene = parse_scenario(kHead + GetParam().text, "s.toml");
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr(GetParam().message));
  EXPECT_THAT(scene.error().message, HasSubstr("; expected "));
  EXPECT_THAT(scene.error().message, Not(HasSubstr("\n")));
}

std::string name_of(const testing::TestParamInfo<Mistake>& made) {
  return made.param.name;
}

const std::string kDrive = "[motion]\nkind = \"drive\"\n";

INSTANTIATE_TEST_SUITE_P(
    Each, ScenarioFileRefuses,
    testing::Values(
        Mistake{"unknown_table", "[sky]\n" + kStand, "s.toml:4: unknown key \"sky\""},
        Mistake{"unknown_key", kStand + "speed = 1\n",
                "s.toml:7: unknown key \"speed\" in [motion]; expected one of kind, at, yaw_deg"},
        Mistake{"no_motion", "", "s.toml:1: no table [motion]"},
        Mistake{"motion_of_nothing", "[vehicle]\nkind = \"none\"\n" + kStand,
                "s.toml:6: [motion] without a vehicle"},
        Mistake{"unknown_kind", "[motion]\nkind = \"fly\"\n",
                "s.toml:5: kind is \"fly\"; expected one of drive, stand,"},
        Mistake{"no_kind", "[motion]\nat = [0, 0]\n", "s.toml:4: [motion] has no key \"kind\""},
        Mistake{"kind_is_no_text", "[motion]\nkind = 3\n", "s.toml:5: kind is a whole number"},
        Mistake{"outside", kDrive + "way_points = [[0, 0],\n[0, 5]]\n",
                "s.toml:7: [0, 5] is outside the hall; expected |x| up to 11 and |y| up to 4.5"},
        Mistake{"stands_outside", "[motion]\nkind = \"stand\"\nat = [12, 0]\n",
                "s.toml:6: [12, 0] is outside the hall"},
        Mistake{"one_way_point", kDrive + "way_points = [[0, 0]]\n",
                "s.toml:6: way_points is a list of 1; expected 2 places"},
        Mistake{"no_way_points", kDrive, "s.toml:4: [motion] has no key \"way_points\""},
        Mistake{"a_place_twice", kDrive + "way_points = [[0, 0], [0, 0]]\n",
                "s.toml:6: way_points has one place twice in a row"},
        Mistake{"a_place_of_three", kDrive + "way_points = [[0, 0, 1], [1, 1, 1]]\n",
                "s.toml:6: way_points has a list of 3"},
        Mistake{"a_place_of_text", kDrive + "way_points = [[0, \"x\"], [1, 1]]\n",
                "s.toml:6: way_points has a text"},
        Mistake{"to_and_fro", kDrive + "way_points = [[0, 0], [1, 1]]\n",
                "s.toml:6: way_points is a way that turns on the spot at [0, 0]"},
        Mistake{"back_again", kDrive + "closed = false\nway_points = [[0, 0], [1, 2], [0, 0]]\n",
                "s.toml:7: way_points is a way that turns on the spot at [1, 2]"},
        Mistake{"no_speed", kDrive + "way_points = [[0, 0], [1, 1]]\nspeed_m_s = 0\n",
                "s.toml:7: speed_m_s is 0; expected a number of metres a second above 0"},
        Mistake{"speed_nan", kDrive + "way_points = [[0, 0], [1, 1]]\nspeed_m_s = nan\n",
                "s.toml:7: speed_m_s is nan"},
        Mistake{"times_back",
                "[motion]\nkind = \"kidnap\"\nplaces = [[0, 0, 0, 0],\n[0, 1, 0, 0]]\n",
                "s.toml:7: places has from_s 0"},
        Mistake{"no_line", "[motion]\nkind = \"crane_lines\"\nlines = []\n",
                "s.toml:6: lines is a list of 0"},
        Mistake{"line_of_no_length",
                "[motion]\nkind = \"crane_lines\"\nlines = [[0, 0, 1, 0, 0, 1]]\n",
                "s.toml:6: lines has a line of no length"},
        Mistake{
            "nobody_sees",
            "[motion]\nkind = \"stand\"\nat = [10, 4]\n[[camera]]\nat = [0, 0, 5]\naim = [0, 0, "
            "0]\n[[camera]]\nat = [1, 0, 5]\naim = [1, 0, 0]\n",
            "s.toml:4: no camera sees the target at any tick"},
        Mistake{"never_there", "[motion]\nkind = \"kidnap\"\nplaces = [[500, 0, 0, 0]]\n",
                "s.toml:4: no camera sees the target at any tick"},
        Mistake{"one_camera", kStand + "[cameras]\ncount = 1\n", "s.toml:8: count is 1"},
        Mistake{"many_cameras", kStand + "[cameras]\ncount = 17\n",
                "s.toml:8: count is 17; expected a whole number from 2 to 16"},
        Mistake{"field", kStand + "[cameras]\nfield_deg = [80, 60]\n",
                "s.toml:8: field_deg is [80, 60]"},
        Mistake{"lens", kStand + "[cameras]\nlens = \"zoom\"\n",
                "s.toml:8: lens is \"zoom\"; expected one of radial, pinhole, fisheye"},
        Mistake{"count_and_list",
                kStand + "[cameras]\ncount = 2\n[[camera]]\nat = [0, 0, 5]\naim = [0, 0, 0]\n",
                "count and [[camera]]; expected one of them"},
        Mistake{"same_name",
                kStand +
                    "[[camera]]\nname = \"a\"\nat = [0, 0, 5]\naim = [0, 0, 0]\n[[camera]]\nname = "
                    "\"a\"\nat = [1, 0, 5]\naim = [0, 0, 0]\n",
                "s.toml:12: name is \"a\" again"},
        Mistake{"fault_of_nobody",
                kStand +
                    "[[camera_fault]]\ncamera = \"cam13\"\nkind = \"dead\"\nfrom_s = 0\nto_s = "
                    "1\n",
                "s.toml:8: camera is \"cam13\"; expected the name of a camera"},
        Mistake{"fault_of_no_kind",
                kStand + "[[camera_fault]]\ncamera = \"cam1\"\nfrom_s = 0\nto_s = 1\n",
                "s.toml:7: [[camera_fault]] has no key \"kind\""},
        Mistake{"fault_backwards",
                kStand + "[[camera_fault]]\ncamera = \"cam1\"\nkind = \"dead\"\nfrom_s = 3\nto_s = "
                         "1\n",
                "s.toml:11: to_s is 1; expected a time after from_s"},
        Mistake{"share", kStand + "[grabber]\ndrop_share = 1.5\n",
                "s.toml:8: drop_share is 1.5; expected a number from 0 to 1"},
        Mistake{"line_time", kStand + "[sensor]\nline_time_us = 20\n", "s.toml:8: line_time_us"},
        Mistake{"light", kStand + "[[light_change]]\ngroup = \"moon\"\nat_s = 1\nto = 1\n",
                "s.toml:8: group is \"moon\""},
        Mistake{"light_to_what", kStand + "[[light_change]]\ngroup = \"sun\"\nat_s = 1\n",
                "s.toml:7: [[light_change]] has no key \"to\""},
        Mistake{"person_in_the_wall", kStand + "[[person]]\nway_points = [[0, 6]]\n",
                "s.toml:8: [0, 6] is outside the hall"},
        Mistake{"one_person_no_list", kStand + "[person]\nway_points = [[0, 0]]\n",
                "s.toml:7: person is a table; expected tables [[person]]"},
        Mistake{"cover_of_nothing",
                "[vehicle]\nkind = \"none\"\n[[cover]]\nsize_m = [1, 1]\nto_s = 1\n",
                "s.toml:6: [[cover]] without a vehicle"},
        Mistake{"dots", "[vehicle]\ndots = 2\n" + kStand, "s.toml:5: dots is 2"},
        Mistake{"background", kStand + "[dots]\nbackground_px = 20\n",
                "s.toml:8: background_px is 20; expected an odd whole number"},
        Mistake{"no_toml", "[motion\n", "s.toml:4: "}),
    name_of);

TEST(ScenarioFile, TheHeadIsCheckedToo) {
  const auto complaint = [](const std::string& head) {
    const auto scene = parse_scenario(head + kStand, "s.toml");
    return scene ? "accepted" : scene.error().message;
  };
  EXPECT_THAT(complaint("[scenario]\nname = \"s\"\nticks = 0\n"),
              HasSubstr("s.toml:3: ticks is 0; expected a whole number from 1 to 1000000"));
  EXPECT_THAT(complaint("[scenario]\nname = \"s\"\nseed = -1\n"),
              HasSubstr("s.toml:3: seed is -1"));
  EXPECT_THAT(complaint("[scenario]\n"), HasSubstr("s.toml:1: [scenario] has no key \"name\""));
  EXPECT_THAT(complaint(""), HasSubstr("s.toml:1: no table [scenario]"));
}

TEST(ScenarioFile, AFileThatIsNotThereIsSaidInOneLine) {
  const auto scene = load_scenario("/nowhere/x.toml");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message, "/nowhere/x.toml: no such file; expected a scenario file");
}

TEST(FindScenario, TakesAPathOrABuiltInName) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("own.toml", "x");
  EXPECT_EQ(find_scenario(file.string()), file);
  const auto drive = find_scenario("drive");
  ASSERT_TRUE(drive);
  EXPECT_EQ(drive->filename(), "drive.toml");
  const auto none = find_scenario("no such thing");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message,
              HasSubstr("no such scenario; expected a file or one of calibration, camera_faults,"));
}

TEST(ScenarioFile, CamerasAreKnockedAgainst) {
  const auto scene = parse_scenario(
      "[scenario]\nname = \"s\"\n[motion]\nkind = \"stand\"\nat = [0.0, 0.0]\n"
      "[[camera_move]]\ncamera = \"cam3\"\nat_s = 2\nshift_m = [0.0, 0.02, 0.0]\n"
      "[[camera_move]]\ncamera = \"cam2\"\nat_s = 1\nturn_deg = [0.0, 90.0, 0.0]\n",
      "s.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->camera_moves.size(), 2U);
  EXPECT_EQ(scene->camera_moves[0].camera, 1U);
  EXPECT_EQ(scene->camera_moves[1].shift_m, Eigen::Vector3d(0.0, 0.02, 0.0));
  // About the picture's downward axis: it looks to where its right was.
  const SimCamera& before = scene->cameras[1].camera;
  const SimCamera after = moved(before, scene->camera_moves[0]);
  EXPECT_LT((after.rotation().row(2) - before.rotation().row(0)).norm(), 1e-12);
  EXPECT_EQ(after.centre_m(), before.centre_m());
  const auto nothing = parse_scenario(
      "[scenario]\nname = \"s\"\n[motion]\nkind = \"stand\"\nat = [0.0, 0.0]\n"
      "[[camera_move]]\ncamera = \"cam3\"\nat_s = 2\n",
      "s.toml");
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().message,
            "s.toml:7: camera is not moved at all; expected turn_deg, shift_m or both");
}

class BuiltInScenario : public testing::TestWithParam<const char*> {};

TEST_P(BuiltInScenario, Loads) {
  const auto file = find_scenario(GetParam());
  ASSERT_TRUE(file) << file.error().message;
  const auto scene = load_scenario(*file);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->name, GetParam());
  EXPECT_FALSE(scene->description.empty());
}

INSTANTIATE_TEST_SUITE_P(All, BuiltInScenario,
                         testing::Values("drive", "clutter", "people", "lights", "sun_blooming",
                                         "ramp", "crane_lines", "survey_grid", "occlusion",
                                         "kidnap", "two_views", "camera_faults", "three_dots",
                                         "eight_dots", "empty", "calibration", "iris_drift",
                                         "iris_stuck"));

TEST(BuiltInScenarios, TwoViewsIsAPlaceThatTwoCamerasSee) {
  const Scene scene = *load_scenario(*find_scenario("two_views"));
  for (const TargetDot& dot : scene.target) {
    EXPECT_EQ(cameras_on(scene.cameras, truth(scene, 0.0)->to_world(dot.centre_m)), 2);
  }
}

}  // namespace
}  // namespace dottrack::host_sim
