#pragma once
// A whole calibration, from pictures of surveyed dots to a folder with models.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/workstation/calibrate/camera_inputs.h"
#include "app/workstation/calibrate/figures.h"
#include "app/workstation/calibrate/fit/calibration.h"
#include "app/workstation/calibrate/labelling/observe.h"
#include "hal/base/result.h"

namespace dottrack::calibrate {

struct PictureRequest {
  std::filesystem::path dots;  // the survey
  InputFiles inputs;
  ObserveOptions observe;
  CalibrationOptions calibrate;
  std::optional<Half> fit;   // of the dots; nothing: all
  std::optional<Half> test;  // on the others
  // Takes the part that is done; from any thread, one by one. False stops the calibration.
  std::function<bool(double)> go_on;
};

struct PictureCalibration {
  std::vector<SurveyedDot> dots;
  Calibration calibration;
  std::optional<HalfFigures> tested;
  std::vector<std::string> remarks;
};

// An error is one line that says which file or camera, and what to do.
Result<PictureCalibration> calibrate_pictures(const PictureRequest& request);

// rig.toml, a model file a camera, report.html, residuals.csv and report.json; the folder is made
// when absent, older models of these cameras are replaced. `target`: that the rig file shall have;
// empty: none.
Result<void> write_calibration(const PictureCalibration& done, const std::filesystem::path& target,
                               const std::filesystem::path& folder);

}  // namespace dottrack::calibrate
