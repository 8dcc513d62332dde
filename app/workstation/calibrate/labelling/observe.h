#pragma once
// From pictures to labelled observations, without a hand on any point.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/workstation/calibrate/labelling/camera_labels.h"
#include "app/workstation/calibrate/views.h"
#include "hal/base/result.h"

namespace dottrack::calibrate {

struct ObserveOptions {
  BlobOptions blobs;
  bool either_polarity = true;  // dark dots are looked for where bright ones are none
  unsigned threads = 0;         // 0: as many as the machine has; no matter to the result
  std::function<void(double)> progress = {};  // the part that is done; from any thread, one by one
};

struct Observed {
  std::vector<CameraViews> views;  // in the order of the inputs
  std::vector<std::string> remarks;
};

// An error is one line that names the camera and what to do: no dots, too few dots, dots that fit
// nowhere or in several ways, exchanged cameras, mirrored coordinates, a wrong unit.
Result<Observed> observe(std::span<const SurveyedDot> dots, const std::vector<CameraInput>& inputs,
                         const ObserveOptions& options = {});

}  // namespace dottrack::calibrate
