#include "app/firmware/device_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "app/firmware/bus_check.h"

namespace dottrack::firmware {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> find_watchdogs() {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/dev", ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("watchdog") && name.size() > 8) found.push_back(entry.path().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

// A TOML string: libcamera's ids hold backslashes.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string can_comment(const drivers::CanInterface& can) {
  std::string text = can.driver.empty() ? "virtual" : can.driver;
  text += can.up ? ", up" : ", down";
  if (can.bit_rate > 0) text += fmt::format(", {} bit/s", can.bit_rate);
  return can.fd ? text + ", FD" : text;
}

const drivers::GpioChip* find_chip(const Devices& devices, const std::string& name) {
  const auto is_it = [&](const drivers::GpioChip& chip) {
    return chip.label == name || chip.path == name || fs::path(chip.path).filename() == name;
  };
  const auto it = std::find_if(devices.chips.begin(), devices.chips.end(), is_it);
  return it == devices.chips.end() ? nullptr : &*it;
}

void check_chip(const Devices& devices, const std::string& use, const std::string& name,
                unsigned highest_line, std::vector<std::string>& lines) {
  const drivers::GpioChip* chip = find_chip(devices, name);
  if (chip == nullptr) {
    lines.push_back(fmt::format("{}: no GPIO chip {} here", use, quoted(name)));
  } else if (highest_line >= chip->lines) {
    lines.push_back(fmt::format("{}: GPIO chip {} has no line {}; expected one below {}", use,
                                quoted(name), highest_line, chip->lines));
  }
}

unsigned highest_line(const config::IrisConfig& iris) {
  return std::max({iris.step_line, iris.direction_line, iris.enable_line.value_or(0),
                   iris.auto_line.value_or(0), iris.end_stop_line.value_or(0)});
}

void check_cameras(const config::RigConfig& config, const Devices& devices,
                   std::vector<std::string>& lines) {
  for (std::size_t i = 0; i < config.cameras.size(); ++i) {
    const config::CameraUnitConfig& unit = config.unit.cameras[i];
    const std::string use = fmt::format("camera {}", config.cameras[i].name);
    const bool found =
        std::any_of(devices.cameras.begin(), devices.cameras.end(),
                    [&](const drivers::CameraListing& camera) { return camera.id == unit.device; });
    if (unit.device.empty()) {
      lines.push_back(use + ": the rig file names no device; expected a libcamera id");
    } else if (!found) {
      lines.push_back(fmt::format("{}: no camera {} here", use, quoted(unit.device)));
    }
    if (unit.iris) {
      check_chip(devices, "iris of " + config.cameras[i].name, unit.iris->chip,
                 highest_line(*unit.iris), lines);
    }
  }
}

void check_can(const config::RigConfig& config, const Devices& devices,
               std::vector<std::string>& lines) {
  const std::string& name = config.unit.can.interface;
  const auto it = std::find_if(devices.can.begin(), devices.can.end(),
                               [&](const auto& can) { return can.name == name; });
  if (it == devices.can.end()) {
    lines.push_back(fmt::format("[can]: no CAN interface {} here", quoted(name)));
  } else if (!it->up) {
    lines.push_back(
        fmt::format("[can]: interface {} is down; expected it up, with a bit rate", quoted(name)));
  } else if (auto overload = overload_of(config, *it)) {
    lines.push_back(std::move(*overload));
  } else if (config.unit.can.addressing.fd && !it->fd) {
    lines.push_back(
        fmt::format("[can]: interface {} is not set up for CAN FD; expected \"fd on\", "
                    "or fd = false in the rig file",
                    quoted(name)));
  }
}

}  // namespace

Devices find_devices() {
  Devices devices;
  if (auto cameras = drivers::list_cameras()) {
    devices.cameras = std::move(*cameras);
  } else {
    devices.faults.push_back(cameras.error().message);
  }
  if (auto can = drivers::list_can_interfaces()) {
    devices.can = std::move(*can);
  } else {
    devices.faults.push_back(can.error().message);
  }
  devices.chips = drivers::list_gpio_chips();
  devices.watchdogs = find_watchdogs();
  return devices;
}

std::string describe(const Devices& devices) {
  std::string text =
      fmt::format("# {} cameras: one line for a [[camera]] each\n", devices.cameras.size());
  for (const drivers::CameraListing& camera : devices.cameras) {
    text += fmt::format("device = {}  # {}, {}\n", quoted(camera.id), camera.model,
                        fmt::join(camera.sizes, ", "));
  }
  text +=
      fmt::format("\n# {} GPIO chips: for [trigger], [lamp] and irises\n", devices.chips.size());
  for (const drivers::GpioChip& chip : devices.chips) {
    text += fmt::format("chip = {}  # {}, {} lines\n", quoted(chip.label), chip.path, chip.lines);
  }
  text += fmt::format("\n# {} CAN interfaces: for [can]\n", devices.can.size());
  for (const drivers::CanInterface& can : devices.can) {
    text += fmt::format("interface = {}  # {}\n", quoted(can.name), can_comment(can));
  }
  text += fmt::format("\n# {} watchdogs: for [loop]\n", devices.watchdogs.size());
  for (const std::string& watchdog : devices.watchdogs) {
    text += fmt::format("watchdog = {}\n", quoted(watchdog));
  }
  for (const std::string& fault : devices.faults) text += fmt::format("# {}\n", fault);
  return text;
}

std::vector<std::string> missing(const config::RigConfig& config, const Devices& devices) {
  std::vector<std::string> lines;
  check_cameras(config, devices, lines);
  check_can(config, devices, lines);
  const config::UnitConfig& unit = config.unit;
  if (unit.trigger) {
    check_chip(devices, "[trigger]", unit.trigger->line.chip, unit.trigger->line.line, lines);
  }
  if (unit.lamp) check_chip(devices, "[lamp]", unit.lamp->chip, unit.lamp->line, lines);
  const auto& dogs = devices.watchdogs;
  const std::string& dog = unit.loop.watchdog;
  if (!dog.empty() && std::find(dogs.begin(), dogs.end(), dog) == dogs.end()) {
    lines.push_back(fmt::format("[loop]: no watchdog {} here", quoted(dog)));
  }
  return lines;
}

}  // namespace dottrack::firmware
