#include "tests/board/harness/unit_rig.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "host_sim/scenarios/scene_files.h"
#include "tests/board/harness/wiring.h"

namespace dottrack::board {
namespace {

std::string camera_keys(const host_sim::SceneCamera& camera, std::size_t index) {
  const std::size_t first = index * kLinesPerIris;
  // In single quotes TOML leaves a backslash alone.
  return fmt::format(
      "device = '{}'\nexposure_ms = {:.3f}\ngain = {:.3f}\n"
      "iris = {{ chip = \"{}\", step = {}, direction = {}, enable = {}, auto = {}, "
      "travel_steps = {}, steps_per_s = {:.1f}, backlash_steps = {}, limits = [0.1, 1.0], "
      "opening = {} }}\n",
      camera_id(index + 1), camera.exposure_s * 1e3, camera.gain, kGpioChip, first, first + 1,
      first + 2, first + 3, kIrisTravel_steps, kIrisRate_steps_per_s, kIrisBacklash_steps,
      kIrisOpening);
}

std::string tables() {
  return fmt::format(
      "\n[trigger]\nchip = \"{0}\"\nline = {1}\ncameras_follow = false\n"
      "\n[lamp]\nchip = \"{0}\"\nline = {2}\n"
      "\n[loop]\nwatchdog = \"/dev/watchdog0\"\nwatchdog_s = {3:.1f}\n"
      "\n[recording]\nfolder = \"{4}\"\nmin_free_mb = {5:.1f}\n",
      kGpioChip, kTriggerLine, kLampLine, kWatchdog_s, kRecordingFolder, kRecordingFree_mb);
}

}  // namespace

std::string camera_id(std::size_t port) {
  return fmt::format("\\_SB_.PCI0-{}:1.0-1d6b:0102", port);
}

std::string with_unit_keys(const host_sim::Scene& scene, const std::string& rig_toml) {
  std::string text;
  std::istringstream lines(rig_toml);
  std::size_t camera = 0;
  bool in_camera = false;
  for (std::string line; std::getline(lines, line);) {
    text += line + "\n";
    if (line.starts_with('[')) in_camera = line == "[[camera]]";
    if (in_camera && line.starts_with("name = ")) {
      text += camera_keys(scene.cameras.at(camera), camera);
      ++camera;
    }
  }
  return text + tables();
}

Result<void> write_unit_rig(const host_sim::Scene& scene, const std::filesystem::path& folder) {
  if (auto written = host_sim::write_rig(scene, folder); !written) return written;
  const std::filesystem::path file = folder / "rig.toml";
  std::stringstream rig;
  rig << std::ifstream(file).rdbuf();
  std::ofstream out(file, std::ios::trunc);
  out << with_unit_keys(scene, rig.str());
  out.close();
  if (!out) return fail(fmt::format("{}: cannot write the file", file.string()));
  return {};
}

}  // namespace dottrack::board
