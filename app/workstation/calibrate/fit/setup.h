#pragma once
// From surveys and views to an adjustment of one camera or of all.

#include <span>
#include <vector>

#include "app/workstation/calibrate/fit/adjustment.h"
#include "app/workstation/calibrate/fit/calibration.h"

namespace dottrack::calibrate {

// A camera before it is adjusted.
struct StartedCamera {
  geometry::CameraModel start;
  ImageExtent extent;
  double distance_m = 1.0;
  bool flat = false;        // its dots are in one plane
  bool hold_scale = false;  // and seen straight on: the focal length is that of the start
};

// Errors name the camera and what to do.
Result<StartedCamera> started(std::span<const SurveyedDot> dots, const CameraViews& views);

// All of one mind about which way round the world is; else an error.
Result<void> check_handedness(std::span<const CameraViews> views,
                              std::span<const StartedCamera> cameras);

AdjustedCamera prepared(const StartedCamera& camera, const LensKind& kind, std::uint64_t seed);

std::vector<AdjustedDot> surveyed(std::span<const SurveyedDot> dots, double default_sigma_m);

std::vector<View> views_of(const CameraViews& views, std::size_t camera);

}  // namespace dottrack::calibrate
