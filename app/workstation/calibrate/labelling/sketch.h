#pragma once
// A camera model as the labelling has it: good to a pixel or so, found from few and doubtful pairs.

#include <Eigen/Core>
#include <optional>
#include <span>

#include "app/core/geometry/camera_model.h"

namespace dottrack::calibrate {

// q = R P + t;  u = q.xy / q.z;  m = 1 + k1 |u|^2 + k2 |u|^4;  pixel = f (m u.x, a m u.y) + centre
struct Sketch {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();   // world to camera
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();  // camera
  double focal_px = 1.0;
  double aspect = 1.0;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double k1 = 0.0;
  double k2 = 0.0;

  Eigen::Vector3d place_m() const { return -(rotation.transpose() * translation_m); }
};

// Nothing: behind the camera, or beyond where the lens's distortion folds.
std::optional<Eigen::Vector2d> project(const Sketch& sketch, const Eigen::Vector3d& p_world);

geometry::Cahvor as_cahvor(const Sketch& sketch);
// The nearest sketch; of a CAHVORE with L = 0 or the like, only where the lens is about linear.
Sketch as_sketch(const geometry::CameraModel& model);

// What is believed of a camera before the pairs are looked at: standard deviations about `about`.
struct SketchPrior {
  Sketch about;
  double place_m = 0.0;       // 0: not known
  double rotation_rad = 0.0;  // 0: not known
  double log_focal = 1.5;
  double centre_px = 100.0;
  double log_aspect = 0.02;
  double distortion = 0.3;
};

// Square pixels, the axis at the image's middle within a seventh of its width, any focal length.
SketchPrior any_camera(int width_px, int height_px);

struct SketchFit {
  Sketch sketch;
  double cost = 0.0;     // half the sum of robust squares, prior included
  double spread_px = 0;  // median distance of pixel and projection
};

// Robust least squares from a start; a pair off by much more than `scale_px` counts little.
SketchFit fit_sketch(const Sketch& start, const SketchPrior& prior,
                     std::span<const Eigen::Vector3d> points,
                     std::span<const Eigen::Vector2d> pixels, double scale_px, int steps = 20);

}  // namespace dottrack::calibrate
