#include "app/firmware/device_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dottrack::firmware {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Devices board() {
  Devices devices;
  devices.cameras = {{.id = R"(\_SB_.PCI0-1)", .model = "Mono", .sizes = {"640x480 R8"}},
                     {.id = "second", .model = "Mono", .sizes = {"640x480 R8", "320x240 R8"}}};
  devices.chips = {{.path = "/dev/gpiochip0", .label = "pl061", .lines = 8},
                   {.path = "/dev/gpiochip1", .label = "iris", .lines = 48}};
  devices.can = {
      {.name = "can0", .driver = "mcp251xfd", .up = true, .bit_rate = 500000, .fd = true},
      {.name = "vcan0", .driver = "", .up = false, .bit_rate = 0, .fd = false}};
  devices.watchdogs = {"/dev/watchdog0"};
  return devices;
}

config::RigConfig rig() {
  config::RigConfig config;
  config.cameras = {{.name = "north", .model_path = ""}, {.name = "south", .model_path = ""}};
  config.unit.cameras[0].device = R"(\_SB_.PCI0-1)";
  config.unit.cameras[1].device = "second";
  config.unit.cameras[1].iris = config::IrisConfig{.chip = "iris",
                                                   .step_line = 4,
                                                   .direction_line = 5,
                                                   .enable_line = {},
                                                   .auto_line = 47,
                                                   .end_stop_line = {},
                                                   .travel_steps = 10};
  config.unit.trigger = config::TriggerConfig{.line = {.chip = "gpiochip0", .line = 7}};
  config.unit.lamp = config::LineConfig{.chip = "/dev/gpiochip0", .line = 6};
  config.unit.loop.watchdog = "/dev/watchdog0";
  return config;
}

TEST(DeviceReport, IsTomlToPaste) {
  EXPECT_EQ(describe(board()),
            "# 2 cameras: one line for a [[camera]] each\n"
            "device = \"\\\\_SB_.PCI0-1\"  # Mono, 640x480 R8\n"
            "device = \"second\"  # Mono, 640x480 R8, 320x240 R8\n"
            "\n# 2 GPIO chips: for [trigger], [lamp] and irises\n"
            "chip = \"pl061\"  # /dev/gpiochip0, 8 lines\n"
            "chip = \"iris\"  # /dev/gpiochip1, 48 lines\n"
            "\n# 2 CAN interfaces: for [can]\n"
            "interface = \"can0\"  # mcp251xfd, up, 500000 bit/s, FD\n"
            "interface = \"vcan0\"  # virtual, down\n"
            "\n# 1 watchdogs: for [loop]\n"
            "watchdog = \"/dev/watchdog0\"\n");
}

TEST(DeviceReport, WhatCouldNotBeListedIsToldAsAComment) {
  Devices devices;
  devices.faults = {"no CAN in this kernel"};
  EXPECT_THAT(describe(devices), HasSubstr("\n# no CAN in this kernel\n"));
}

TEST(DeviceReport, ABoardThatHasEverythingMissesNothing) {
  EXPECT_THAT(missing(rig(), board()), IsEmpty());
}

TEST(DeviceReport, EverythingThatIsNotThereIsOneLine) {
  config::RigConfig config = rig();
  config.unit.cameras[0].device = "gone";
  config.unit.cameras[1].device = "";
  config.unit.cameras[1].iris->auto_line = 48;
  config.unit.can.interface = "can7";
  config.unit.trigger->line.chip = "gpiochip9";
  config.unit.lamp->line = 8;
  config.unit.loop.watchdog = "/dev/watchdog3";
  EXPECT_THAT(
      missing(config, board()),
      ElementsAre("camera north: no camera \"gone\" here",
                  "camera south: the rig file names no device; expected a libcamera id",
                  "iris of south: GPIO chip \"iris\" has no line 48; expected one below 48",
                  "[can]: no CAN interface \"can7\" here",
                  "[trigger]: no GPIO chip \"gpiochip9\" here",
                  "[lamp]: GPIO chip \"/dev/gpiochip0\" has no line 8; expected one below 8",
                  "[loop]: no watchdog \"/dev/watchdog3\" here"));
}

TEST(DeviceReport, AnInterfaceTooSlowForTheMessagesIsNamed) {
  config::RigConfig config = rig();
  config.unit.can.interface = "can0";
  Devices slow = board();
  for (drivers::CanInterface& can : slow.can) {
    if (can.name == "can0") can.bit_rate = 50'000;
  }
  const std::vector<std::string> lines = missing(config, slow);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_THAT(lines[0], testing::StartsWith("[can]: interface can0 runs at 50 kbit/s: CAN: "));
  EXPECT_THAT(lines[0], testing::HasSubstr("max_load"));
}

TEST(DeviceReport, FdPosesNeedAnFdInterface) {
  config::RigConfig config = rig();
  config.unit.can.interface = "can0";
  config.unit.can.addressing.fd = true;
  Devices classic = board();
  for (drivers::CanInterface& can : classic.can) can.fd = false;
  EXPECT_THAT(missing(config, classic), ElementsAre(testing::HasSubstr("not set up for CAN FD")));
}

TEST(DeviceReport, AnInterfaceThatIsDownIsNamed) {
  config::RigConfig config = rig();
  config.unit.can.interface = "vcan0";
  EXPECT_THAT(missing(config, board()),
              ElementsAre("[can]: interface \"vcan0\" is down; expected it up, with a bit rate"));
}

}  // namespace
}  // namespace dottrack::firmware
