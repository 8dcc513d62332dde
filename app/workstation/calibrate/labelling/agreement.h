#pragma once
// Which of several labellings, where the dots alone leave it open.

#include <string>
#include <vector>

#include "app/workstation/calibrate/labelling/camera_labels.h"

namespace dottrack::calibrate {

// How well two cameras' labellings agree on what else is on the surface that carries the dots, a
// scratch, a screw, an edge: other blobs of the first camera, carried over that surface into the
// second camera's image, against the number that would be met by chance; in standard deviations.
double agreement(const Scene& a, const Growth& in_a, const Scene& b, const Growth& in_b);

// How upright the camera stands, from -1 to 1, and, half as weighty, whether it looks down on the
// dots: z is up in the world unless the camera looks along it, then y.
double uprightness(const Growth& labelling);

// How far, from 0, a labelling's camera is from what was known beforehand.
double strangeness(const CameraInput& input, const Growth& labelling);

struct LabelledCamera {
  Scene scene;
  std::vector<Growth> labellings;  // equally probable; decide() leaves one
};

// Leaves one labelling to each camera: the one that fits what is known of the camera, that agrees
// with the other cameras on other marks, or that is upright. Remarks say what was decided without
// the dots. An error names a camera whose labelling remains open.
Result<std::vector<std::string>> decide(const std::vector<CameraInput>& inputs,
                                        std::vector<LabelledCamera>& cameras);

}  // namespace dottrack::calibrate
