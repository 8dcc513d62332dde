#pragma once
// A hall with cameras under its ceiling and surveyed dots on its floor, walls and boxes, as
// numbers.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/core/geometry/camera_model.h"
#include "app/workstation/calibrate/views.h"

namespace dottrack::test {

struct HallOptions {
  std::size_t cameras = 12;
  std::size_t dots = 60;
  double survey_sigma_m = 0.001;
  double claimed_sigma_m = 0.001;  // what the file says
  double image_sigma_px = 0.05;
  double claimed_image_sigma_px = 0.1;
  double extent = 1.0;      // of the part of the hall in which the dots are and cameras look
  double focal_px = 460.0;  // 70 degrees
  Eigen::Vector2d radial{-0.12, 0.02};  // r1, r2
  double radial_sigma = 0.0;            // by which lenses differ, as a part of the radial terms
  double aspect = 0.002;                // pixels are this far from square, at most
  double axis = 0.008;                  // and the lens's axis this far from A, each way
  std::uint64_t seed = 1;
};

struct Hall {
  std::vector<geometry::CameraModel> truths;
  std::vector<Eigen::Vector3d> places_m;  // where the dots really are
  std::vector<calibrate::SurveyedDot> dots;
  std::vector<calibrate::CameraViews> views;
  std::vector<Eigen::Vector3d> unseen_m;  // places that no dot is at
};

inline constexpr int kHallColumns = 640;
inline constexpr int kHallRows = 480;

Hall make_hall(const HallOptions& options);

// Root mean square distance in pixels of where a model shows the unseen places from where they are
// to be seen, over those that the true camera has in its image; their number is added to `count`.
double rms_on_unseen_px(const Hall& hall, std::size_t camera, const geometry::CameraModel& model,
                        std::size_t& count);

}  // namespace dottrack::test
