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

// Far more than the best of many tries at strewn blobs would reach, and most of what the camera
// ought to see.
bool convincing(const Scene& scene, const Growth& growth);

}  // namespace dottrack::calibrate
