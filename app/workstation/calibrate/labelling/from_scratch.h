#pragma once
// Labels without any guess of the camera: patterns of neighbours, grown and checked.

#include <vector>

#include "app/workstation/calibrate/labelling/growth.h"
#include "app/workstation/calibrate/labelling/patches.h"

namespace dottrack::calibrate {

// Labellings that are about equally probable, the most probable first; one, if the dots tell all.
// Empty: none that could not be chance.
std::vector<Growth> labels_from_scratch(const Scene& scene, const SurveyIndex& survey,
                                        const SketchPrior& prior);

}  // namespace dottrack::calibrate
