#pragma once
// First sketches of a camera from a few labelled dots, without any guess.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "app/workstation/calibrate/labelling/sketch.h"

namespace dottrack::calibrate {

// Views of the points as a far camera has them (scaled orthography), carried to several focal
// lengths. Dots of one plane look alike from two sides: both are there. Empty: fewer than three
// points, or points on a line.
std::vector<Sketch> far_views(std::span<const Eigen::Vector3d> points,
                              std::span<const Eigen::Vector2d> pixels, const SketchPrior& prior);

// The best fits from those starts, best first; at most `keep`, each different from those before.
std::vector<SketchFit> sketches(std::span<const Eigen::Vector3d> points,
                                std::span<const Eigen::Vector2d> pixels, const SketchPrior& prior,
                                double scale_px, std::size_t keep);

}  // namespace dottrack::calibrate
