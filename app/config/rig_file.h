#pragma once
// rig.toml -> Rig. Start-up only: may allocate, may fail with one clear line.

#include <filesystem>
#include <string>
#include <vector>

#include "app/config/unit_config.h"
#include "app/core/rig.h"
#include "hal/base/result.h"

namespace dottrack::config {

struct CameraEntry {
  std::string name;  // unique in the rig
  std::filesystem::path model_path;
};

struct RigConfig {
  std::string name = "rig";
  double frame_rate_hz = 30.0;
  std::vector<CameraEntry> cameras;  // in the order of rig.cameras
  std::string target_name = "target";
  core::Rig rig;
  UnitConfig unit;
};

// An unknown key, a missing file, a unit that makes no sense or a degenerate target is an error
// that names the file, the line and what was expected.
Result<RigConfig> load_rig(const std::filesystem::path& path);

}  // namespace dottrack::config
