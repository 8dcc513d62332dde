#pragma once
// How a dot of the target should be seen by one camera (paper sections 3.2.2, 3.3).

#include <Eigen/Core>

#include "app/core/geometry/optics.h"
#include "app/core/geometry/projected_circle.h"
#include "app/core/image/identify.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::tracking {

// A dot in a pose: world coordinates.
struct PlacedDot {
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // zero where the target gives none
  double diameter_m = 0.0;

  bool has_normal() const { return !normal.isZero(0.0); }
};

PlacedDot placed(const core::TargetDot& dot, const core::Pose& pose);

// False where a dot shows the camera its back, or its face so flatly that nothing is left of it.
bool faces(const core::Camera& camera, const PlacedDot& dot);

struct ExpectedDot {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double radius_px = 0.0;  // of the largest circle it may show as
  image::RegionGate gate;
  bool has_ellipse = false;  // its normal is known
  geometry::ImageEllipse ellipse;
};

// False when the camera cannot see the dot: outside its image or its distance range, or turned
// away.
bool expect(const core::Camera& camera, const geometry::Optics& optics, const PlacedDot& dot,
            ExpectedDot& expected);

}  // namespace dottrack::tracking
