#pragma once
// What one camera's pictures alone say of which blob is which dot.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/workstation/calibrate/input/picture_folder.h"
#include "app/workstation/calibrate/input/survey_file.h"
#include "app/workstation/calibrate/labelling/growth.h"
#include "hal/base/result.h"

namespace dottrack::calibrate {

// What is known of a camera before its pictures are looked at.
struct CameraInput {
  CameraPictures pictures;
  std::optional<geometry::CameraModel> approximate;
  std::optional<Eigen::Vector3d> near_m;
  std::vector<Seed> seeds;
};

// What a guess may be off by.
struct GuessTolerance {
  double place_m = 0.3;  // standard deviations
  double rotation_rad = 0.06;
  double log_focal = 0.05;
};

SketchPrior prior_of(const CameraInput& input, int width_px, int height_px,
                     const GuessTolerance& tolerance = {});

// The blobs of the mean picture and of the ticks' pictures. An error names a file.
Result<Scene> scene_of(std::span<const SurveyedDot> dots, const CameraPictures& pictures,
                       const BlobOptions& options);

// Labellings that are about equally probable, the most probable first; none where nothing is sure.
std::vector<Growth> label_camera(const Scene& scene, const SurveyIndex& survey,
                                 const CameraInput& input);

// From a few dots that somebody pointed at.
std::vector<Growth> labels_from_seeds(const Scene& scene, const SurveyIndex& survey,
                                      const SketchPrior& prior, std::span<const Seed> seeds);

}  // namespace dottrack::calibrate
