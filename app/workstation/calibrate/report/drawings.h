#pragma once
// The pictures of a calibration's report, as elements of SVG.

#include <span>
#include <string>
#include <vector>

#include "app/workstation/calibrate/fit/calibration.h"
#include "app/workstation/calibrate/report/error_map.h"

namespace dottrack::calibrate {

// A camera's image with an arrow a view: from where the dot was seen to where its surveyed place
// would show, enlarged by the factor that is drawn beside it. Left-out views are red, those of
// suspect dots orange; the dots' hull is what the model rests on.
std::string residual_drawing(const CameraCalibration& camera, std::span<const SuspectDot> suspects);

// The expected error by colour, with the cameras' places.
std::string map_drawing(const ErrorMap& map, const Calibration& calibration);

// A length with the unit that suits it: "1.23 mm".
std::string length_words(double metres);

}  // namespace dottrack::calibrate
