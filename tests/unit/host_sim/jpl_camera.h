#pragma once
// The simulator's camera of the same lens as one of JPL's models. For tests only.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <variant>

#include "app/core/geometry/camera_model.h"
#include "host_sim/renderer/sim_camera.h"

namespace dottrack::test {

// Of the lens itself; the image plane is the same in all models.
inline void set_lens(const geometry::Cahv& m, Eigen::Vector3d& axis, host_sim::Lens& lens) {
  lens.kind = host_sim::LensKind::pinhole;
  axis = m.a;
}
inline void set_lens(const geometry::Cahvor& m, Eigen::Vector3d& axis, host_sim::Lens& lens) {
  lens.kind = host_sim::LensKind::radial;
  lens.radial = {m.r[0], m.r[1], m.r[2]};
  axis = m.o;
}
inline void set_lens(const geometry::Cahvore& m, Eigen::Vector3d& axis, host_sim::Lens& lens) {
  lens.kind = host_sim::LensKind::fisheye;
  lens.radial = {m.r[0], m.r[1], m.r[2]};
  lens.linearity = m.linearity;
  lens.pupil_m = {m.e[0], m.e[1], m.e[2]};
  axis = m.o;
}

// A pixel is d'.H / d'.A, so a common factor of A, H and V changes nothing; the axis O is made
// unit, which moves pixels of a model whose O has six digits by up to 1e-3 px.
inline host_sim::SimCamera sim_camera(const geometry::CameraModel& model, int width_px,
                                      int height_px) {
  return std::visit(
      [&](const auto& m) {
        const double length = m.a.norm();
        const Eigen::Vector3d z = m.a / length;
        const Eigen::Vector3d h = m.h / length;
        const Eigen::Vector3d v = m.v / length;
        const Eigen::Vector3d y = (v - v.dot(z) * z).normalized();
        const Eigen::Vector3d x = y.cross(z);
        Eigen::Matrix3d rotation;
        rotation << x.transpose(), y.transpose(), z.transpose();
        host_sim::Lens lens;
        Eigen::Vector3d axis;
        set_lens(m, axis, lens);
        lens.axis = rotation * axis;
        lens.focal_x_px = h.dot(x);
        lens.skew_px = h.dot(y);
        lens.centre_x_px = h.dot(z);
        lens.focal_y_px = v.dot(y);
        lens.centre_y_px = v.dot(z);
        return host_sim::SimCamera(m.c, rotation, lens, width_px, height_px);
      },
      model);
}

}  // namespace dottrack::test
