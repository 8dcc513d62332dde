#pragma once
// How a dot of the target should be seen by one camera (paper sections 3.2.2, 3.3).

#include <Eigen/Core>

#include "app/core/estimation/dot_spread.h"
#include "app/core/estimation/small_step.h"
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

// Where the target should be at an instant, and how it moves.
struct Expectation {
  Expectation() = default;
  // At rest, as far as is known, and whenever.
  Expectation(const core::Pose& still) : pose(still) {}  // NOLINT(google-explicit-constructor)

  core::Pose pose;
  estimation::Twist motion;
  Time at{};
  bool moving = false;               // `motion` and `at` mean something
  double spread_m = 0.0;             // how far off a dot may be beyond what the gates allow for
  estimation::DotSpread dot_spread;  // about their places on the target
};

// How far a dot will have come a while after the instant of the expectation.
Eigen::Vector3d way_of(const Expectation& expected, const PlacedDot& dot, double after_s);

// False where a dot shows the camera its back, or its face so flatly that nothing is left of it.
bool faces(const core::Camera& camera, const PlacedDot& dot);

struct ExpectedDot {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double radius_px = 0.0;  // of the largest circle it may show as
  double pixels_per_m = 0.0;
  image::RegionGate gate;
  bool has_ellipse = false;  // its normal is known
  geometry::ImageEllipse ellipse;
};

// False when the camera cannot see the dot: outside its image or its distance range, or turned
// away.
bool expect(const core::Camera& camera, const geometry::Optics& optics, const PlacedDot& dot,
            ExpectedDot& expected);

}  // namespace dottrack::tracking
