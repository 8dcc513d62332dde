#pragma once
// `dottrack calibrate --repair`: the model of a moved camera anew, from a run that others tracked.

#include <filesystem>
#include <string>

#include "hal/base/result.h"

namespace dottrack::calibrate {

struct RepairRequest {
  std::string camera;            // its name in the rig
  std::filesystem::path rig;     // rig.toml with the old model
  std::filesystem::path run;     // folder with poses.csv, or that file
  std::filesystem::path frames;  // the run's recorded frames; empty: poses.csv has the views
  std::filesystem::path out;     // folder for the new model file, named as the old one
};

// Writes the new model with its covariance and returns what a person wants to know of it. An error
// is one line: what, where, what was expected.
Result<std::string> repair(const RepairRequest& request);

}  // namespace dottrack::calibrate
