#pragma once
// A CAHVOR model as five vectors and three numbers, its equations written out, and the simulator's
// camera of the same lens. For tests only.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "host_sim/renderer/sim_camera.h"

namespace dottrack::test {

struct CahvorNumbers {
  Eigen::Vector3d c, a, h, v, o, r;
};

inline Eigen::Vector2d project(const CahvorNumbers& m, const Eigen::Vector3d& p) {
  const Eigen::Vector3d d = p - m.c;
  const double w = d.dot(m.o);
  const Eigen::Vector3d l = d - w * m.o;
  const double tau = l.squaredNorm() / (w * w);
  const Eigen::Vector3d bent = d + (m.r[0] + m.r[1] * tau + m.r[2] * tau * tau) * l;
  return Eigen::Vector2d(bent.dot(m.h), bent.dot(m.v)) / bent.dot(m.a);
}

inline host_sim::SimCamera sim_camera(const CahvorNumbers& m, int width_px, int height_px) {
  const Eigen::Vector3d z = m.a.normalized();
  const Eigen::Vector3d y = (m.v - m.v.dot(z) * z).normalized();
  const Eigen::Vector3d x = y.cross(z);
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), y.transpose(), z.transpose();
  host_sim::Lens lens;
  lens.focal_x_px = m.h.dot(x);
  lens.skew_px = m.h.dot(y);
  lens.centre_x_px = m.h.dot(z);
  lens.focal_y_px = m.v.dot(y);
  lens.centre_y_px = m.v.dot(z);
  lens.axis = rotation * m.o;
  lens.radial = {m.r[0], m.r[1], m.r[2]};
  return {m.c, rotation, lens, width_px, height_px};
}

}  // namespace dottrack::test
