#include "app/firmware/hardware.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/core/protocol/command.h"
#include "app/firmware/bus_check.h"

namespace dottrack::firmware {
namespace {

Duration milliseconds(double ms) {
  return Duration(std::llround(ms * 1e6));
}

Result<std::unique_ptr<drivers::GpioOutputLine>> open_line(const config::LineConfig& line,
                                                           const std::string& purpose) {
  return drivers::GpioOutputLine::open({line.chip, line.line, line.active_low}, purpose);
}

Result<std::vector<drivers::LibcameraSettings>> camera_settings(const config::RigConfig& config) {
  std::vector<drivers::LibcameraSettings> cameras;
  for (std::size_t i = 0; i < config.cameras.size(); ++i) {
    const config::CameraUnitConfig& unit = config.unit.cameras[i];
    const std::string& name = config.cameras[i].name;
    if (unit.device.empty()) {
      return fail(
          fmt::format("camera {} has no device; expected a libcamera id, as dottrackd "
                      "--list-devices tells it",
                      name));
    }
    const core::Camera& camera = config.rig.cameras[i];
    cameras.push_back({.name = name,
                       .id = unit.device,
                       .width_px = camera.width_px,
                       .height_px = camera.height_px,
                       .exposure = {milliseconds(unit.exposure_ms), unit.gain},
                       .stamp_offset = milliseconds(unit.stamp_offset_ms)});
  }
  return cameras;
}

std::vector<std::optional<drivers::IrisWiring>> iris_wiring(const config::RigConfig& config) {
  std::vector<std::optional<drivers::IrisWiring>> irises(config.cameras.size());
  for (std::size_t i = 0; i < config.cameras.size(); ++i) {
    const auto& iris = config.unit.cameras[i].iris;
    if (!iris) continue;
    irises[i] = drivers::IrisWiring{.name = config.cameras[i].name,
                                    .chip = iris->chip,
                                    .step_line = iris->step_line,
                                    .direction_line = iris->direction_line,
                                    .enable_line = iris->enable_line,
                                    .auto_line = iris->auto_line,
                                    .end_stop_line = iris->end_stop_line,
                                    .travel_steps = iris->travel_steps,
                                    .steps_per_s = iris->steps_per_s,
                                    .backlash_steps = iris->backlash_steps,
                                    .limits = iris->limits};
  }
  return irises;
}

drivers::SocketCanSettings can_settings(const config::CanConfig& can) {
  drivers::SocketCanSettings settings;
  settings.interface = can.interface;
  settings.fd = can.addressing.fd;
  if (can.commands) {
    settings.listen_ids = {protocol::command_id(can.addressing)};
    settings.listen_extended = can.addressing.extended;
  }
  return settings;
}

Result<void> open_lines(const config::UnitConfig& unit, Hardware& hardware) {
  if (unit.trigger) {
    auto line = open_line(unit.trigger->line, "dottrack trigger");
    if (!line) return tl::unexpected<Error>(line.error());
    hardware.trigger = std::move(*line);
  }
  if (unit.lamp) {
    auto line = open_line(*unit.lamp, "dottrack lamp");
    if (!line) return tl::unexpected<Error>(line.error());
    hardware.lamp = std::move(*line);
  }
  return {};
}

Result<void> open_cameras(const config::RigConfig& config, const rtos::Clock& clock,
                          Hardware& hardware) {
  auto settings = camera_settings(config);
  if (!settings) return tl::unexpected<Error>(settings.error());
  const auto& trigger = config.unit.trigger;
  const auto exposing = trigger && trigger->cameras_follow ? drivers::Exposing::on_trigger
                                                           : drivers::Exposing::freely;
  auto cameras = drivers::LibcameraGrabber::open(std::move(*settings), period_of(config),
                                                 hardware.trigger.get(),
                                                 /*allow_missing=*/true, clock, exposing);
  if (!cameras) return tl::unexpected<Error>(cameras.error());
  hardware.cameras = std::move(*cameras);
  return {};
}

}  // namespace

Duration period_of(const config::RigConfig& config) {
  return Duration(std::llround(1e9 / config.frame_rate_hz));
}

Result<std::unique_ptr<Hardware>> Hardware::open(const config::RigConfig& config,
                                                 const rtos::Clock& clock) {
  auto hardware = std::make_unique<Hardware>();
  if (auto done = open_lines(config.unit, *hardware); !done) {
    return tl::unexpected<Error>(done.error());
  }
  if (const auto interfaces = drivers::list_can_interfaces()) {
    if (auto overload = overload_of(config, *interfaces)) return fail(std::move(*overload));
  }
  auto can = drivers::SocketCanBus::open(can_settings(config.unit.can), clock);
  if (!can) return tl::unexpected<Error>(can.error());
  hardware->can = std::move(*can);
  auto irises = drivers::GpioIris::open(iris_wiring(config), clock);
  if (!irises) return tl::unexpected<Error>(irises.error());
  hardware->irises = std::move(*irises);
  if (auto done = open_cameras(config, clock, *hardware); !done) {
    return tl::unexpected<Error>(done.error());
  }
  return hardware;
}

}  // namespace dottrack::firmware
