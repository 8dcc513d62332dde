#pragma once
// Labels from a guess: about where the camera is, perhaps also how it points and what its lens is.

#include <vector>

#include "app/workstation/calibrate/labelling/growth.h"

namespace dottrack::calibrate {

// Rotations, and focal lengths where the prior leaves them open, from two dots and two blobs at a
// time; the best by how many other dots they explain are fitted and settled. The prior has a place;
// a rotation of sigma 0 is any rotation. Labellings that are about equally probable, the most
// probable first, without regard to whether they could be chance.
std::vector<Growth> labels_from_guess(const Scene& scene, const SurveyIndex& survey,
                                      const SketchPrior& prior);

}  // namespace dottrack::calibrate
