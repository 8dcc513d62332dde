#include "app/workstation/calibrate/repair/repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

#include "app/config/camera_file.h"
#include "app/config/rig_file.h"
#include "app/telemetry/output_file.h"
#include "app/workstation/calibrate/repair/camera_repair.h"
#include "app/workstation/calibrate/repair/moved_dots.h"

namespace dottrack::calibrate {
namespace {

std::string names_of(const config::RigConfig& config) {
  std::string names;
  for (const config::CameraEntry& camera : config.cameras) {
    names += (names.empty() ? "" : ", ") + camera.name;
  }
  return names;
}

std::string summary(const std::string& camera, const CameraRepair& repair,
                    const std::filesystem::path& out) {
  const double degrees = 180.0 / M_PI;
  return fmt::format(
      "{}: turned by {:.4f} degrees (+- {:.4f}), carried by {:.2f} mm (+- {:.2f})\n"
      "  {} views in {} ticks, {} of them odd; off by {:.2f} px before, {:.3f} px now (RMS of a "
      "coordinate)\nnew model: {}\n",
      camera, degrees * repair.turn_rad.norm(), degrees * repair.turn_sigma_rad.norm(),
      1000.0 * repair.shift_m.norm(), 1000.0 * repair.shift_sigma_m.norm(), repair.views,
      repair.ticks, repair.odd_views, repair.rms_before_px, repair.rms_px, out.string());
}

}  // namespace

Result<std::string> repair(const RepairRequest& request) {
  const auto config = config::load_rig(request.rig, config::Targets::taken_as_they_are);
  if (!config) return tl::unexpected<Error>(config.error());
  const auto entry =
      std::find_if(config->cameras.begin(), config->cameras.end(),
                   [&](const config::CameraEntry& c) { return c.name == request.camera; });
  if (entry == config->cameras.end()) {
    return fail(fmt::format("{}: no camera {}; expected one of {}", request.rig.string(),
                            request.camera, names_of(*config)));
  }
  const auto camera = static_cast<std::size_t>(entry - config->cameras.begin());
  auto ticks = workstation::read_run(request.run, *config);
  if (!ticks) return tl::unexpected<Error>(ticks.error());
  if (!request.frames.empty()) {
    auto moved = find_moved_dots(*config, camera, *ticks, request.frames);
    if (!moved) return tl::unexpected<Error>(moved.error());
    *ticks = std::move(moved->ticks);
  }
  auto old = config::read_camera_file(entry->model_path);
  if (!old) return tl::unexpected<Error>(old.error());
  const auto repaired = repair_camera(config->rig, camera, *ticks, old->covariance);
  if (!repaired) {
    return fail(
        fmt::format("{}: {}: {}", request.run.string(), request.camera, repaired.error().message));
  }
  old->model = repaired->model;
  old->covariance = repaired->covariance;
  std::error_code error;
  std::filesystem::create_directories(request.out, error);
  const std::filesystem::path file = request.out / entry->model_path.filename();
  if (auto done = telemetry::write_file(file, config::write_camera_text(*old)); !done) {
    return tl::unexpected<Error>(done.error());
  }
  return summary(request.camera, *repaired, file);
}

}  // namespace dottrack::calibrate
