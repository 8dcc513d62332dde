#include "app/core/exposure/light_meter.h"

#include <algorithm>

#include "app/core/geometry/projected_circle.h"
#include "app/core/tracking/expected_dot.h"

namespace dottrack::exposure {
namespace {

constexpr double kSpeedKept = 0.9;  // of the fastest dot's, from tick to tick

DotSpot spot_of(const core::DotView& view) {
  return {view.pixel.cast<double>(), static_cast<double>(view.semi_major_px),
          static_cast<double>(view.semi_minor_px), static_cast<double>(view.angle_rad)};
}

// Where the pose puts a dot whose normal is known; false where the camera cannot see it.
bool expected_spot(const core::Camera& camera, const core::TargetDot& dot, const core::Pose& pose,
                   DotSpot& spot) {
  const tracking::PlacedDot placed = tracking::placed(dot, pose);
  const double range_m = (placed.place_m - geometry::centre(camera.model)).norm();
  if (range_m < camera.distance_min_m || range_m > camera.distance_max_m) return false;
  if (!placed.has_normal() || !tracking::faces(camera, placed)) return false;
  geometry::ImageEllipse ellipse;
  if (geometry::project(camera.model, placed.place_m, spot.centre_px) !=
          geometry::OpticsStatus::ok ||
      geometry::project_disc(camera.model, placed.place_m, placed.normal, 0.5 * placed.diameter_m,
                             ellipse) != geometry::OpticsStatus::ok) {
    return false;
  }
  spot.semi_major_px = ellipse.semi_major_px;
  spot.semi_minor_px = ellipse.semi_minor_px;
  spot.angle_rad = ellipse.angle_rad;
  return true;
}

bool mostly_saturated(const DotLight& dot) {
  return dot.inside_px > 0 && 2 * dot.saturated_px > dot.inside_px;
}

}  // namespace

void LightMeter::add(const DotLight& dot, LightReading& reading) {
  if (dot.inside_px == 0) return;
  if (reading.dots == 0 || dot.peak_dn > reading.brightest.peak_dn) reading.brightest = dot;
  ++reading.dots;
  inside_px_ += dot.inside_px;
  reading.saturated_px += dot.saturated_px;
  reading.saturated_around_px += dot.saturated_around_px;
  reading.saturated_share = static_cast<double>(reading.saturated_px) / inside_px_;
}

void LightMeter::follow(std::size_t camera, std::size_t dot, const core::DotView& view, Time at) {
  Track& track = tracks_[camera][dot];
  const Eigen::Vector2d pixel = view.pixel.cast<double>();
  const double after_s = to_seconds(at - track.at);
  double& speed_px_s = readings_[camera].speed_px_s;
  if (track.known && after_s > 0.0 && after_s < 1.0) {
    speed_px_s = std::max(speed_px_s, (pixel - track.pixel).norm() / after_s);
  }
  track = {true, pixel, at};
}

void LightMeter::read_dots(std::size_t camera, const ImageView& image,
                           const core::TickResult& result) {
  LightReading& reading = readings_[camera];
  for (std::size_t i = 0; i < rig_->target.dots.size(); ++i) {
    const core::DotView& view = result.dots[i].views[camera];
    if (view.seen) {
      add(measure_dot(image, spot_of(view)), reading);
      follow(camera, i, view, result.capture_time);
      continue;
    }
    DotSpot spot;
    if (!expected_spot(rig_->cameras[camera], rig_->target.dots[i], result.pose, spot)) continue;
    const DotLight dot = measure_dot(image, spot);
    if (mostly_saturated(dot)) add(dot, reading);
  }
}

const LightReading& LightMeter::read(std::size_t camera, const core::CameraFrame& frame,
                                     const core::TickResult& result) {
  LightReading& reading = readings_[camera];
  const double speed_px_s = kSpeedKept * reading.speed_px_s;
  reading = {};
  reading.speed_px_s = speed_px_s;
  reading.delivered = result.cameras[camera].delivered;
  if (!reading.delivered) return reading;
  reading.image = measure_image(frame.image);
  inside_px_ = 0;
  if (result.has_pose) read_dots(camera, frame.image, result);
  return reading;
}

}  // namespace dottrack::exposure
