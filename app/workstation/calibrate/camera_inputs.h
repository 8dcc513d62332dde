#pragma once
// Everything that is known of the cameras before a calibration, from the files that say it.

#include <filesystem>
#include <span>
#include <vector>

#include "app/workstation/calibrate/labelling/camera_labels.h"
#include "hal/base/result.h"

namespace dottrack::calibrate {

struct InputFiles {
  std::filesystem::path images;
  std::filesystem::path rig;     // empty: none; so are the others
  std::filesystem::path models;  // folder with <camera>.cahv, .cahvor or .cahvore
  std::filesystem::path places;
  std::filesystem::path seeds;
};

// A camera for each that has pictures. An error names a file, or a camera of a file that has none.
Result<std::vector<CameraInput>> read_inputs(const InputFiles& files,
                                             std::span<const SurveyedDot> dots);

}  // namespace dottrack::calibrate
