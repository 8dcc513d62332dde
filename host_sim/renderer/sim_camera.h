#pragma once
// The simulator's camera: a pinhole with radial distortion, in mathematics of its own. It shares
// nothing with the tracker's camera models, so that an error there cannot cancel out here.
//
// In camera axes (x right, y down, z along the sensor's normal), with p the point seen from the
// camera's centre and o the lens's axis, t = tan(angle between p and o):
//   p' = p + (r0 + r1 t^2 + r2 t^4) l,   l = p - (p.o) o,
//   pixel = (K p')_xy / (K p')_z,        K = [fx skew cx; 0 fy cy; 0 0 1].
// The same lens as the CAHVOR model with C the centre, A = z, O = o, R = (r0, r1, r2).

#include <Eigen/Core>
#include <array>
#include <optional>

namespace dottrack::host_sim {

struct Lens {
  double focal_x_px = 460.0;
  double focal_y_px = 460.0;
  double skew_px = 0.0;
  double centre_x_px = 319.5;
  double centre_y_px = 239.5;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // o; normalised on construction
  std::array<double, 3> radial{0.0, 0.0, 0.0};      // r0 r1 r2
};

class SimCamera {
 public:
  // rotation's rows: the camera's x, y, z axes in the world, orthonormal.
  SimCamera(const Eigen::Vector3d& centre_m, const Eigen::Matrix3d& rotation, const Lens& lens,
            int width_px, int height_px);

  // Nothing for a point behind the camera or further off the axis than max_tangent().
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_world) const;

  // Direction of the line of sight through a pixel, world, not unit: its component along the
  // undistorted sensor normal is about 1, so that directions interpolate well between pixels.
  // Nothing outside the lens's domain.
  std::optional<Eigen::Vector3d> direction(const Eigen::Vector2d& pixel) const;

  const Eigen::Vector3d& centre_m() const { return centre_m_; }
  const Eigen::Matrix3d& rotation() const { return rotation_; }
  const Lens& lens() const { return lens_; }
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  // Up to where the distortion is one-to-one: tangent of the angle off the lens's axis.
  double max_tangent() const { return max_tangent_; }

 private:
  Eigen::Vector3d centre_m_;
  Eigen::Matrix3d rotation_;
  Lens lens_;
  int width_px_;
  int height_px_;
  double max_tangent_;
};

// A camera at `centre_m` that looks at `aim_m`, its picture's top upwards and then turned by
// `roll_rad` about the line of sight. Not for a camera that looks straight down (then: `up`).
Eigen::Matrix3d looking_at(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& aim_m,
                           double roll_rad, const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ());

}  // namespace dottrack::host_sim
