#pragma once
// What the tracker is told before it starts: its cameras, its target, its tolerances.

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "app/core/geometry/camera_model.h"
#include "app/core/limits.h"
#include "app/core/model_correlations.h"
#include "hal/base/static_vector.h"
#include "hal/base/time.h"

namespace dottrack::core {

enum class Polarity : std::uint8_t { bright, dark };

struct Camera {
  geometry::CameraModel model;
  int width_px = 0;
  int height_px = 0;
  double distance_min_m = 0.0;  // how far a dot may be from the camera's centre
  double distance_max_m = 0.0;
  int intensity_min_dn = 0;  // how bright a dot's pixels may be, both ends included
  int intensity_max_dn = 255;
  int min_contrast_dn = 0;  // > 0: a dot's pixels also differ by this much from the background
  double min_contrast_part = 0.0;  // > 0: and by this part of the background
  int background_px = 21;          // odd width of the surround whose mean is the background
  Polarity polarity = Polarity::bright;
  // What the model's covariance (S of its file) leaves open: each is the model, wrong by one
  // standard deviation in one of as many independent ways. None: the model is taken as exact.
  StaticVector<geometry::CameraModel, kMaxModelErrors> model_errors;
};

struct TargetDot {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // vehicle coordinates
  double diameter_m = 0.0;
  std::optional<Eigen::Vector3d> normal;  // unit, vehicle coordinates
};

struct Target {
  StaticVector<TargetDot, kMaxDots> dots;
  // How far the centre of a dot's light may be from its place above, each coordinate's standard
  // deviation: how well the dots were surveyed, and how evenly they are lit.
  double dot_sigma_m = 0.0;
  bool upright = true;      // the vehicle's z axis never points down
  double max_step_m = 0.2;  // a dot may not move further between ticks
};

// How the vehicle can move, whatever it is told: the largest speed and acceleration of its origin
// and of its turning, in any direction.
struct MotionLimits {
  double max_speed_m_s = 2.0;
  double max_acceleration_m_s2 = 2.0;
  double max_turn_rate_rad_s = 2.0943951023931953;           // 120 degrees a second
  double max_turn_acceleration_rad_s2 = 4.1887902047863905;  // 240 degrees a second squared
};

struct TrackingLimits {
  double max_rms_residual_m = 0.02;
  int lost_after_ticks = 5;
  // A lock more probably false than this is held back until further ticks confirm it.
  double max_false_lock_probability = 1e-6;
  // While tracking, whole images are searched for a better explanation every so many ticks; 0:
  // never.
  int watch_every_ticks = 1;
  // Without a pose of the images, the motion so far is carried on for so long; 0: never.
  Duration coast = std::chrono::milliseconds(500);
};

struct Rig {
  StaticVector<Camera, kMaxCameras> cameras;
  ModelCorrelations model_correlations;
  Target target;
  MotionLimits vehicle;
  TrackingLimits limits;
};

double largest_dot_diameter_m(const Target& target);
double smallest_dot_diameter_m(const Target& target);

}  // namespace dottrack::core
