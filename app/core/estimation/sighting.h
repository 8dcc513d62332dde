#pragma once
// A region as a line of sight: what the geometry needs to know of it.

#include <Eigen/Core>
#include <cstdint>

#include "app/core/estimation/dot_size.h"
#include "app/core/geometry/optics.h"
#include "app/core/geometry/triangulation.h"
#include "app/core/image/region.h"
#include "app/core/limits.h"
#include "app/core/rig.h"
#include "hal/base/static_vector.h"

namespace dottrack::estimation {

struct Sighting {
  geometry::SightLine line;  // world
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d box_min_px = Eigen::Vector2d::Zero();  // outer edges of the bounding box
  Eigen::Vector2d box_max_px = Eigen::Vector2d::Zero();
  RangeWindow window;                 // where a dot of the target would look this size
  double angular_diameter_rad = 0.0;  // of the semi-major axis, both halves
  std::uint16_t region = 0;           // index among the camera's regions
  double semi_major_px = 0.0;         // the region's ellipse
  double semi_minor_px = 0.0;
  double angle_rad = 0.0;  // of the major axis from +x towards +y
  // d(pixel)/d(point) times the point's range: the same all along the line of sight.
  geometry::ProjectionJacobian pixels_per_rad = geometry::ProjectionJacobian::Zero();

  // Place, ellipse and box of the region.
  void take_shape(const image::Region& of) {
    pixel = of.centroid_px;
    semi_major_px = of.semi_major_px;
    semi_minor_px = of.semi_minor_px;
    angle_rad = of.angle_rad;
    box_min_px = {of.x_min - 0.5, of.y_min - 0.5};
    box_max_px = {of.x_max + 0.5, of.y_max + 0.5};
  }

  // Where a point near the line of sight projects to. Linear: a point a hundredth of its range off
  // the line is a few hundredths of a pixel off.
  Eigen::Vector2d pixel_of(const Eigen::Vector3d& point_m) const {
    const Eigen::Vector3d offset = point_m - line.ray.origin;
    return pixel + pixels_per_rad * offset / offset.dot(line.ray.direction);
  }

  bool box_contains(const Eigen::Vector2d& p) const {
    return p.x() >= box_min_px.x() && p.x() <= box_max_px.x() && p.y() >= box_min_px.y() &&
           p.y() <= box_max_px.y();
  }

  // Inside the bounding box, widened on every side by a part of its size and a pixel count.
  bool box_contains(const Eigen::Vector2d& p, double widen_part, double widen_px) const {
    const Eigen::Vector2d slack =
        widen_part * (box_max_px - box_min_px) + Eigen::Vector2d::Constant(widen_px);
    return (p.array() >= (box_min_px - slack).array()).all() &&
           (p.array() <= (box_max_px + slack).array()).all();
  }
};

using Sightings = StaticVector<Sighting, core::kMaxRegions>;

// What the geometry needs to know of a region, but for its line of sight: false when the lens has
// none there or no dot of the target could look this size within the camera's distance limits.
bool describe_sighting(const core::Camera& camera, const geometry::Optics& optics,
                       const DiameterRange& diameter, const image::Region& region,
                       Sighting& sighting);

// Adds the line of sight; false when the lens has none there.
bool add_line_of_sight(const core::Camera& camera, Sighting& sighting);

// Both: the region's line of sight; false when the lens has none there or no dot of the target
// could look this size within the camera's distance limits.
bool make_sighting(const core::Camera& camera, const geometry::Optics& optics,
                   const DiameterRange& diameter, const image::Region& region, Sighting& sighting);

}  // namespace dottrack::estimation
