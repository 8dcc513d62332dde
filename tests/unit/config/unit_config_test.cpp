// What a rig file says of the unit: every key read, every default, one mistake each refused.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <string_view>

#include "app/config/rig_file.h"
#include "tests/unit/config/good_rig.h"
#include "tests/unit/config/mistake.h"

namespace dottrack::config {
namespace {

using test::kGoodRig;
using test::replaced;
using test::RigFolder;

constexpr std::string_view kCameraUnit =
    "device = \"/base/i2c/imx296@1\"\n"  // 17
    "exposure_ms = 2.5\n"                // 18
    "gain = 3\n"                         // 19
    "stamp_offset_ms = -1.5\n"           // 20
    "iris = { chip = \"iris\", step = 4, direction = 5, enable = 6, auto = 7, end_stop = 8, "
    "travel_steps = 80, steps_per_s = 50, backlash_steps = 2, limits = [0.1, 0.9], "
    "opening = 0.8 }\n";  // 21

constexpr std::string_view kUnit =
    "\n"                                  // 34
    "[can]\n"                             // 35
    "interface = \"can1\"\n"              // 36
    "base_id = 0x240\n"                   // 37
    "[trigger]\n"                         // 38
    "chip = \"gpiochip2\"\n"              // 39
    "line = 12\n"                         // 40
    "active_low = true\n"                 // 41
    "cameras_follow = false\n"            // 42
    "[lamp]\n"                            // 43
    "chip = \"gpiochip2\"\n"              // 44
    "line = 13\n"                         // 45
    "[loop]\n"                            // 46
    "priority = 70\n"                     // 47
    "cpu = 3\n"                           // 48
    "watchdog = \"/dev/watchdog0\"\n"     // 49
    "watchdog_s = 5\n"                    // 50
    "[recording]\n"                       // 51
    "folder = \"/var/lib/dottrack/r\"\n"  // 52
    "frames = true\n"                     // 53
    "min_free_mb = 64\n";                 // 54

std::string unit_rig() {
  return replaced(kGoodRig, "device = \"/base/i2c/imx296@1\"\n", kCameraUnit) + std::string(kUnit);
}

UnitConfig load_or_fail(const std::string& text) {
  const RigFolder folder;
  folder.write("rig.toml", text);
  Result<RigConfig> config = load_rig(folder.rig());
  if (!config) throw std::runtime_error(config.error().message);
  return config->unit;
}

TEST(UnitConfigFile, ReadsEveryKeyOfACamera) {
  const CameraUnitConfig camera = load_or_fail(unit_rig()).cameras[1];
  EXPECT_EQ(camera.device, "/base/i2c/imx296@1");
  EXPECT_EQ(camera.exposure_ms, 2.5);
  EXPECT_EQ(camera.gain, 3.0);
  EXPECT_EQ(camera.stamp_offset_ms, -1.5);
  ASSERT_TRUE(camera.iris);
  const IrisConfig wanted{.chip = "iris",
                          .step_line = 4,
                          .direction_line = 5,
                          .enable_line = 6,
                          .auto_line = 7,
                          .end_stop_line = 8,
                          .travel_steps = 80,
                          .steps_per_s = 50.0,
                          .backlash_steps = 2,
                          .limits = {0.1, 0.9},
                          .opening = 0.8};
  EXPECT_EQ(*camera.iris, wanted);
}

TEST(UnitConfigFile, ReadsEveryKeyOfTheUnit) {
  const UnitConfig unit = load_or_fail(unit_rig());
  EXPECT_EQ(
      unit.can,
      (CanConfig{
          .interface = "can1", .addressing = {.base_id = 0x240}, .bit_rates = {}, .rates = {}}));
  ASSERT_TRUE(unit.trigger);
  EXPECT_EQ(unit.trigger->line, (LineConfig{.chip = "gpiochip2", .line = 12, .active_low = true}));
  EXPECT_FALSE(unit.trigger->cameras_follow);
  EXPECT_EQ(unit.lamp, (LineConfig{.chip = "gpiochip2", .line = 13, .active_low = false}));
  EXPECT_EQ(
      unit.loop,
      (LoopConfig{.priority = 70, .cpu = 3, .watchdog = "/dev/watchdog0", .watchdog_s = 5.0}));
  EXPECT_EQ(
      unit.recording,
      (RecordingConfig{.folder = "/var/lib/dottrack/r", .frames = true, .min_free_mb = 64.0}));
}

TEST(UnitConfigFile, NothingOfItIsRequired) {
  const UnitConfig unit = load_or_fail(std::string(kGoodRig));
  UnitConfig defaults;
  defaults.cameras[1].device = "/base/i2c/imx296@1";
  EXPECT_EQ(unit, defaults);
  EXPECT_EQ(unit.can.interface, "can0");
  EXPECT_EQ(unit.can.addressing.base_id, 0x300U);
  EXPECT_FALSE(unit.trigger || unit.lamp || unit.recording);
}

class UnitConfigRefuses : public testing::TestWithParam<Mistake> {};

TEST_P(UnitConfigRefuses, WithOneLine) {
  const RigFolder folder;
  folder.write("rig.toml", replaced(unit_rig(), GetParam().from, GetParam().to));
  EXPECT_EQ(complaint_about(folder), "rig.toml" + GetParam().message);
}

const std::string kLineWords = "; expected a whole number from 0 to 1023";

INSTANTIATE_TEST_SUITE_P(
    Mistakes, UnitConfigRefuses,
    testing::Values(
        Mistake{"Exposure", "exposure_ms = 2.5", "exposure_ms = 0",
                ":18: exposure_ms is 0; expected a number of milliseconds above 0 and up to 1000"},
        Mistake{"IrisKey", "backlash_steps", "backlash",
                ":21: unknown key \"backlash\" in iris; expected one of chip, step, direction, "
                "enable, auto, end_stop, travel_steps, steps_per_s, backlash_steps, limits, "
                "opening"},
        Mistake{"IrisWithoutStep", "step = 4, ", "", ":21: iris has no key \"step\"" + kLineWords},
        Mistake{"IrisLine", "enable = 6", "enable = -6", ":21: enable is -6" + kLineWords},
        Mistake{"IrisLimits", "limits = [0.1, 0.9]", "limits = [0.9, 0.1]",
                ":21: limits is [0.9, 0.1]; expected two numbers, 0 <= narrowest < widest <= 1"},
        Mistake{"IrisOpening", "opening = 0.8", "opening = 0.95",
                ":21: opening is 0.95; expected a number within limits"},
        Mistake{"Interface", "can1", "a-name-that-is-too-long",
                ":36: interface is \"a-name-that-is-too-long\"; expected a network interface such "
                "as can0"},
        Mistake{"BaseId", "0x240", "0x7C1",
                ":37: base_id is 1985; expected a whole number from 0 to 0x7C0, with extended = "
                "true to 0x1FFFFFC0"},
        Mistake{"TriggerWithoutLine", "line = 12\n", "",
                ":38: [trigger] has no key \"line\"" + kLineWords},
        Mistake{"EmptyChip", "chip = \"gpiochip2\"", "chip = \"\"",
                ":39: chip is empty; expected the label, name or path of a GPIO chip"},
        Mistake{"Priority", "priority = 70", "priority = 100",
                ":47: priority is 100; expected a whole number from 1 to 99"},
        Mistake{"WatchdogTime", "watchdog_s = 5", "watchdog_s = 0.5",
                ":50: watchdog_s is 0.5; expected a number of seconds from 1 to 600"},
        Mistake{"Folder", "/var/lib/dottrack/r", "r",
                ":52: folder is \"r\"; expected an absolute path"},
        Mistake{"TableOfAnotherKind", "[lamp]\n", "[[lamp]]\n",
                ":43: lamp is a list of tables; expected a table [lamp]"}),
    name_of);

}  // namespace
}  // namespace dottrack::config
