#pragma once
// Surveyed dots and where cameras saw them to camera models with covariance: each camera's kind of
// model chosen by hold-out, all cameras and dots adjusted together, bad points left out (paper
// section 3.4, [14]), wrongly surveyed dots named.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/core/geometry/camera_model.h"
#include "app/workstation/calibrate/views.h"
#include "hal/base/result.h"

namespace dottrack::calibrate {

// From the simplest to the most general. cahv_radial is CAHVOR with O = A and r1 alone.
enum class ModelKind : std::uint8_t { automatic, cahv, cahv_radial, cahvor, cahvore };

// As a person would write it: "CAHV", "CAHV with one radial term", "CAHVOR", "CAHVORE".
std::string_view to_string(ModelKind kind);

struct CalibrationOptions {
  ModelKind kind = ModelKind::automatic;  // of all cameras; automatic: chosen for each by hold-out
  double default_survey_sigma_m = 0.001;  // of dots whose sigma is 0
  bool estimate_noise = true;             // the sigmas' scale, where the data tell it
  std::size_t folds = 10;                 // of the hold-out; at least 2
  unsigned threads = 0;                   // 0: as many as the machine has; no matter to the result
  std::uint64_t seed = 0;                 // above 0: starts are thrown off at random, as a test
  // Called now and then with the part that is done, 0 to 1, and what is being done, by the thread
  // that called; false: give up.
  std::function<bool(double, const std::string&)> progress = {};
};

struct ResidualOfView {
  std::size_t dot = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d off_px = Eigen::Vector2d::Zero();           // seen less surveyed dot's image
  Eigen::Vector2d off_adjusted_px = Eigen::Vector2d::Zero();  // seen less adjusted dot's image
  Eigen::Vector2d holdout_px = Eigen::Vector2d::Zero();  // as off_px, of a model without this dot
  bool used = true;                                      // false: left out by the automatic editing
};

// Standard deviations of what a person knows a camera by.
struct ParameterSigmas {
  double place_m = 0.0;       // root of the trace, world
  double pointing_rad = 0.0;  // of A, root of the trace
  double roll_rad = 0.0;      // about A
  double scale = 0.0;         // of hs, a part of it
  double centre_px = 0.0;     // of (hc, vc), root of the trace
};

// A kind of model that was tried on a camera alone.
struct TriedModel {
  std::string name;
  std::size_t numbers = 0;      // that were fitted
  double holdout_rms_px = 0.0;  // of dots left out, without those that no model fits
  bool chosen = false;
};

struct CameraCalibration {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  geometry::CameraModel model;
  Eigen::MatrixXd covariance;  // in the order of JPL's files: C A H V [O R [E]]
  ModelKind chosen = ModelKind::cahv;
  double rms_px = 0.0;                   // of what was used, to the surveyed dots
  double rms_adjusted_px = 0.0;          // of what was used, to the adjusted dots
  double holdout_rms_px = 0.0;           // of what was used, by models fitted without the dot
  double image_sigma_px = 0.0;           // typical, of a coordinate: as estimated
  double coverage = 0.0;                 // part of the image within the dots' convex hull, 0 to 1
  std::vector<Eigen::Vector2d> hull_px;  // that hull
  ParameterSigmas sigmas;
  std::vector<TriedModel> tried;  // where there was a choice
  std::vector<ResidualOfView> residuals;
  std::vector<std::string> remarks;
};

struct AdjustedPlace {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  std::size_t views = 0;  // that were used
};

struct SuspectDot {
  std::size_t dot = 0;
  std::string name;
  Eigen::Vector3d off_m = Eigen::Vector3d::Zero();  // adjusted less surveyed
  double sigmas = 0.0;  // how far that is: standard deviations of a normal number as improbable
};

struct Calibration {
  std::vector<CameraCalibration> cameras;  // in the order of the views
  // Of all cameras' vectors together, camera after camera: their own covariances and how their
  // errors go together.
  Eigen::MatrixXd joint_covariance;
  std::vector<AdjustedPlace> dots;   // in the order of the survey
  std::vector<SuspectDot> suspects;  // the worst first
  double survey_scale = 1.0;         // estimated sigma of the survey over what was claimed
  double holdout_rms_px = 0.0;       // of all cameras
  double holdout_rms_m = 0.0;    // of left-out dots triangulated; 0: none is seen by two cameras
  std::size_t holdout_dots = 0;  // that were triangulated
  std::vector<std::string> remarks;
};

// Errors name the camera and what to do: too few dots, dots that do not determine it, a mirrored
// world.
Result<Calibration> calibrate(std::span<const SurveyedDot> dots, std::span<const CameraViews> views,
                              const CalibrationOptions& options = {});

}  // namespace dottrack::calibrate
