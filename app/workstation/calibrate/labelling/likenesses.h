#pragma once
// What else a labelling could be, because the survey looks like itself elsewhere: a grid one pitch
// further, or turned.

#include <vector>

#include "app/workstation/calibrate/labelling/growth.h"
#include "app/workstation/calibrate/labelling/patches.h"

namespace dottrack::calibrate {

// The labelling and all others of the same blobs that are about as probable or more so, the most
// probable first. `margin`: how much lower the log odds may be.
std::vector<Growth> likenesses(const Scene& scene, const SurveyIndex& survey,
                               const SketchPrior& prior, const std::vector<PatchKind>& kinds,
                               const Growth& labelling, double margin);

// The rigid motion that carries the places of the first labelling's blobs to those of the second.
// Identity where there are fewer than three.
struct Likeness {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
};

// The same picture, the world moved: project(moved(s, T), T p) == project(s, p).
Sketch moved(const Sketch& sketch, const Likeness& motion);

}  // namespace dottrack::calibrate
