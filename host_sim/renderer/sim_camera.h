#pragma once
// The simulator's camera: pinhole, radial distortion or fish-eye, in mathematics of its own. It
// shares nothing with the tracker's camera models, so that an error there cannot cancel out here.
//
// In camera axes (x right, y down, z along the sensor's normal), with p the point seen from the
// camera's centre and o the lens's axis:
//   p' = o + radius * unit(p - (p.o) o),   radius by the lens's curve (lens.h),
//   pixel = (K p')_xy / (K p')_z,          K = [fx skew cx; 0 fy cy; 0 0 1].
// The same as the CAHV, CAHVOR and CAHVORE models with C the centre, A = z, O = o, R = (r0, r1, r2)
// and E = (e0, e1, e2), unit A and O.

#include <Eigen/Core>
#include <optional>

#include "host_sim/renderer/lens.h"

namespace dottrack::host_sim {

// A line of sight, world. `direction` is not unit, but smooth from pixel to pixel.
struct Sight {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

class SimCamera {
 public:
  // rotation's rows: the camera's x, y, z axes in the world, orthonormal.
  SimCamera(const Eigen::Vector3d& centre_m, const Eigen::Matrix3d& rotation, const Lens& lens,
            int width_px, int height_px);

  // Nothing for a point that the lens cannot see; the pixel may lie outside the picture.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_world) const;

  // Nothing outside the lens's domain. All sights of a pinhole or radial lens start at the centre;
  // those of a fish-eye at its pupil, which moves.
  std::optional<Sight> sight(const Eigen::Vector2d& pixel) const;

  const Eigen::Vector3d& centre_m() const { return centre_m_; }
  const Eigen::Matrix3d& rotation() const { return rotation_; }
  const Lens& lens() const { return lens_; }
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

 private:
  Eigen::Vector3d centre_m_;
  Eigen::Matrix3d rotation_;
  Lens lens_;
  LensCurve curve_;
  int width_px_;
  int height_px_;
};

// A camera at `centre_m` that looks at `aim_m`, its picture's top upwards and then turned by
// `roll_rad` about the line of sight. Not for a camera that looks straight down (then: `up`).
Eigen::Matrix3d looking_at(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& aim_m,
                           double roll_rad, const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ());

// The rotation by |v| radians about v (Rodrigues).
Eigen::Matrix3d turn(const Eigen::Vector3d& v);

}  // namespace dottrack::host_sim
