#pragma once
// How a flat disc looks in an image (paper section 3.3).

#include <Eigen/Core>

#include "app/core/geometry/camera_model.h"

namespace dottrack::geometry {

struct ImageEllipse {
  double semi_major_px = 0.0;
  double semi_minor_px = 0.0;
  double angle_rad = 0.0;  // of the major axis from +x towards +y, in (-pi/2, pi/2]
};

// The ellipse that a disc around `centre_m` (world) with this unit normal shows as, to first order
// in radius over range: the circle carried through the model's partial derivatives. Off by up to
// 1.5 (radius / range)^2 of the semi-major axis: 0.3 % for a dot of 10 cm a metre away. Not ok
// where the model sees nothing there. The disc's back shows the same ellipse; see facing().
OpticsStatus project_disc(const CameraModel& model, const Eigen::Vector3d& centre_m,
                          const Eigen::Vector3d& normal, double radius_m,
                          ImageEllipse& ellipse) noexcept;

// The same where the derivatives of the projection at the disc's centre are known already.
ImageEllipse disc_ellipse(const ProjectionJacobian& jacobian, const Eigen::Vector3d& normal,
                          double radius_m) noexcept;

// How far the middle of the area that a disc covers in the image is from its centre's pixel: a
// disc's nearer half is shown larger, and lenses bend. To third order in radius over range, from
// the projection's curvature across the disc by second differences: for a camera without
// distortion, where the rim is a conic, -r^2 (J u k u + J w k w) with u and w spanning the disc and
// k = A / (A . (centre - C)). `pixel` and `jacobian` are those of the centre. Zero where the camera
// does not see all of the rim.
Eigen::Vector2d disc_eccentricity(const CameraModel& model, const Eigen::Vector3d& centre_m,
                                  const Eigen::Vector2d& pixel, const ProjectionJacobian& jacobian,
                                  const Eigen::Vector3d& normal, double radius_m) noexcept;

// Cosine of the angle between the normal and the direction to the camera: positive in front.
double facing(const CameraModel& model, const Eigen::Vector3d& centre_m,
              const Eigen::Vector3d& normal) noexcept;

}  // namespace dottrack::geometry
