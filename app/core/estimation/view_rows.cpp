#include "app/core/estimation/view_rows.h"

#include <cmath>

#include "app/core/geometry/projected_circle.h"

namespace dottrack::estimation {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::OpticsStatus;
using geometry::ProjectionJacobian;

// A dot at the instant of a camera's exposure.
struct PlacedDot {
  Vector3d lever_m;  // from the vehicle's origin, world axes
  Vector3d place_m;
};

PlacedDot place(const core::TargetDot& dot, const geometry::RigidMotion& pose, double after_s,
                const Twist& motion) {
  const Vector3d lever = pose.rotation * dot.position_m;
  return {lever, pose.translation_m + lever +
                     after_s * (motion.velocity_m_s + motion.turn_rad_s.cross(lever))};
}

// d(pixel)/d(step), from d(pixel)/d(point). A turn of the pose turns the way that a dot goes about
// the vehicle's origin meanwhile, too.
Matrix26d by_step(const ProjectionJacobian& by_point, const Vector3d& lever_m, double after_s,
                  const Vector3d& turn_rad_s) {
  Matrix26d j;
  j.leftCols<3>() = by_point;
  for (int row = 0; row < 2; ++row) {
    const Vector3d gradient = by_point.row(row).transpose();
    j.row(row).tail<3>() =
        lever_m.cross(gradient + after_s * gradient.cross(turn_rad_s)).transpose();
  }
  return j;
}

// Lower triangle of the square root of a covariance, undone: makes rows of unit variance.
class Whitener {
 public:
  explicit Whitener(const Matrix2d& covariance) {
    const double l00 = std::sqrt(covariance(0, 0));
    l10_ = covariance(1, 0) / l00;
    const double l11 = std::sqrt(covariance(1, 1) - l10_ * l10_);
    per_l00_ = 1.0 / l00;
    per_l11_ = 1.0 / l11;
  }

  template <class Rows>
  void apply(Rows& rows) const {
    rows.row(0) *= per_l00_;
    rows.row(1) = (rows.row(1) - l10_ * rows.row(0)) * per_l11_;
  }

 private:
  double per_l00_;
  double l10_;
  double per_l11_;
};

void add_model_errors(const core::Camera& camera, const Vector3d& place_m, const Vector2d& pixel,
                      ViewRow& row) {
  for (const geometry::CameraModel& wrong : camera.model_errors) {
    Vector2d shown = pixel;
    static_cast<void>(geometry::project(wrong, place_m, shown));
    row.model_errors.push_back(shown - pixel);
  }
}

Matrix2d variance_of(const DotObservation& view, double dot_variance_m2, const ViewRow& row) {
  Matrix2d variance =
      view.covariance_px2 + dot_variance_m2 * (row.by_place * row.by_place.transpose());
  for (const Vector2d& error : row.model_errors) variance += error * error.transpose();
  return variance;
}

bool make_row(const core::Rig& rig, const DotObservation& view, const Vector2d& off_px,
              const CaptureTimes& times, const geometry::RigidMotion& pose, double dot_variance_m2,
              ViewRow& row) {
  const core::Camera& camera = rig.cameras[view.camera];
  const core::TargetDot& dot = rig.target.dots[view.dot];
  const PlacedDot placed = place(dot, pose, times.after_s[view.camera], times.motion);
  Vector2d pixel;
  ProjectionJacobian by_point;
  if (geometry::project(camera.model, placed.place_m, pixel, &by_point) != OpticsStatus::ok) {
    return false;
  }
  row.camera = view.camera;
  row.dot = view.dot;
  row.residual_px = view.centre_px - off_px - pixel;
  row.jacobian =
      by_step(by_point, placed.lever_m, times.after_s[view.camera], times.motion.turn_rad_s);
  row.residual = row.residual_px;
  row.model_errors.clear();
  add_model_errors(camera, placed.place_m, pixel, row);
  row.by_place = by_point;
  const Whitener whitener(variance_of(view, dot_variance_m2, row));
  whitener.apply(row.residual);
  whitener.apply(row.jacobian);
  whitener.apply(row.by_place);
  for (Vector2d& error : row.model_errors) whitener.apply(error);
  return true;
}

}  // namespace

void find_eccentricities(const core::Rig& rig, std::span<const DotObservation> views,
                         const CaptureTimes& times, const geometry::RigidMotion& pose,
                         Eccentricities& offs_px) {
  offs_px.assign(views.size(), Vector2d::Zero());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const geometry::CameraModel& model = rig.cameras[views[i].camera].model;
    const core::TargetDot& dot = rig.target.dots[views[i].dot];
    if (!dot.normal) continue;
    const Vector3d place_m = place(dot, pose, times.after_s[views[i].camera], times.motion).place_m;
    Vector2d pixel;
    ProjectionJacobian by_point;
    if (geometry::project(model, place_m, pixel, &by_point) != OpticsStatus::ok) continue;
    offs_px[i] = geometry::disc_eccentricity(model, place_m, pixel, by_point,
                                             pose.rotation * *dot.normal, 0.5 * dot.diameter_m);
  }
}

void linearise(const core::Rig& rig, std::span<const DotObservation> views,
               const Eccentricities& offs_px, const CaptureTimes& times,
               const geometry::RigidMotion& pose, double dot_variance_m2, ViewRows& rows) {
  rows.clear();
  for (std::size_t i = 0; i < views.size(); ++i) {
    rows.emplace_back();
    if (!make_row(rig, views[i], offs_px[i], times, pose, dot_variance_m2, rows.back()))
      rows.pop_back();
  }
}

}  // namespace dottrack::estimation
