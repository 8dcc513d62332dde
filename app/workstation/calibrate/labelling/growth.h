#pragma once
// From a few labelled dots to all: fit, look for the next ones around, fit again.

#include <vector>

#include "app/workstation/calibrate/labelling/scene.h"
#include "app/workstation/calibrate/labelling/sketch.h"
#include "app/workstation/calibrate/labelling/survey_index.h"

namespace dottrack::calibrate {

// Fewer dots could be anything.
inline constexpr std::size_t kLeastToTell = 8;

// A labelling of one camera's blobs.
struct Growth {
  Sketch sketch;
  Labels labels;
  double spread_px = 0.0;    // median distance of blob and projection
  double log_odds = 0.0;     // that the dots are there, against blobs strewn at random
  std::size_t labelled = 0;  // dots
  std::size_t expected = 0;  // dots that the sketch puts inside the image, facing the camera
};

// Where the sketch sees a dot, if it faces the camera and lies inside the image.
std::optional<Eigen::Vector2d> seen_at(const Scene& scene, const Sketch& sketch, int dot);

// Labels of all dots within the tolerance of their projections, moved as their neighbours' are;
// less where another dot is near. `known`: labels so far, which say how neighbours are moved.
Labels match(const Scene& scene, const SurveyIndex& survey, const Sketch& sketch,
             const Labels& known, double within_px);

// Fits the sketch to the labels and finds what else is where the fit says, nearest dots first.
Growth grow(const Scene& scene, const SurveyIndex& survey, const Sketch& start,
            const SketchPrior& prior, const Labels& labels);

// All dots are looked for at once, within this distance at first.
Growth settle(const Scene& scene, const SurveyIndex& survey, const Sketch& start,
              const SketchPrior& prior, const Labels& labels, double within_px);

// Spread, log odds and counts of a labelling.
void judge(const Scene& scene, Growth& growth);

// Far more than the best of many tries at strewn blobs would reach, and most of what the camera
// ought to see.
bool convincing(const Scene& scene, const Growth& growth);

// The labelled points and pixels, dot by dot.
struct Pairs {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
};
Pairs pairs_of(const Scene& scene, const Labels& labels);

}  // namespace dottrack::calibrate
