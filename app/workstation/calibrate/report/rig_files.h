#pragma once
// What a calibration leaves behind for the tracker: a camera model file each, with covariance, and
// a rig file that names them.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/workstation/calibrate/fit/calibration.h"
#include "hal/base/result.h"

namespace dottrack::calibrate {

struct RigRequest {
  std::string name = "rig";
  std::optional<std::filesystem::path> target =
      std::nullopt;          // a target's dots; copied beside the rig file
  std::string comment = {};  // first line of the model files; empty: what the calibration says
  // Of every camera: how the tracker tells dots from the rest, as [[camera]] has it.
  double min_contrast_part = 0.3;
  double min_contrast_dn = 12.0;
};

struct RigFile {
  std::string name;  // within the folder
  std::string text;
};

// rig.toml, <camera>.cahv, .cahvor or .cahvore, and joint_covariance.csv. Without a target the rig
// file has a table of it in comments and is not complete: the first line says so. The distances are
// those of the dots that a camera saw, with a margin.
Result<std::vector<RigFile>> rig_files(const Calibration& calibration, const RigRequest& request);

}  // namespace dottrack::calibrate
