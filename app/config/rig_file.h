#pragma once
// rig.toml -> Rig. Start-up only: may allocate, may fail with one clear line.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/config/can_load.h"
#include "app/config/unit_config.h"
#include "app/core/rig.h"
#include "hal/base/result.h"

namespace dottrack::config {

struct CameraEntry {
  std::string name;  // unique in the rig
  std::filesystem::path model_path;
};

inline constexpr std::size_t kMaxTargets = 8;

struct TargetEntry {
  std::string name;  // unique in the rig
  core::Target target;
};

struct RigConfig {
  std::string name = "rig";
  double frame_rate_hz = 30.0;
  std::vector<CameraEntry> cameras;    // in the order of rig.cameras
  std::vector<TargetEntry> targets;    // in the order of the file
  std::size_t target_index = 0;        // the one in force: rig.target is its target ...
  std::string target_name = "target";  // ... and this its name
  core::Rig rig;
  UnitConfig unit;
  // CRC-32 (ISO-HDLC, that of zip) of the rig file, the camera models, their joint covariance and
  // the targets' dots, in the order of the tables: the same files have the same number.
  std::uint32_t config_hash = 0;
  // What is no error but should be known, a line each.
  std::vector<std::string> warnings;
};

enum class Targets : std::uint8_t { judged, taken_as_they_are };

// An unknown key, a missing file, a unit that makes no sense or a degenerate target is an error
// that names the file, the line and what was expected; so is, where targets are judged, an
// ambiguous one.
Result<RigConfig> load_rig(const std::filesystem::path& path, Targets targets = Targets::judged);

// The same rig with another of its targets in force; index < config.targets.size().
RigConfig with_target(RigConfig config, std::size_t index);

// What the unit's messages are to the bus, with its largest target.
CanUse can_use(const RigConfig& config);

}  // namespace dottrack::config
