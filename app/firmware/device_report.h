#pragma once
// What a machine has, and whether it is what a rig file asks for.

#include <string>
#include <vector>

#include "app/config/rig_file.h"
#include "drivers/libcamera/libcamera_grabber.h"
#include "drivers/libgpiod/gpio_output_line.h"
#include "drivers/socketcan/socket_can_bus.h"

namespace dottrack::firmware {

struct Devices {
  std::vector<drivers::CameraListing> cameras;
  std::vector<drivers::GpioChip> chips;
  std::vector<drivers::CanInterface> can;
  std::vector<std::string> watchdogs;  // /dev/watchdog0
  std::vector<std::string> faults;     // what could not be listed
};

Devices find_devices();

// TOML, ready to be pasted into rig.toml.
std::string describe(const Devices& devices);

// One line for each thing that the rig asks for and the machine has not.
std::vector<std::string> missing(const config::RigConfig& config, const Devices& devices);

}  // namespace dottrack::firmware
