#include "app/workstation/calibrate/repair/model_vectors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <type_traits>
#include <variant>

namespace dottrack::calibrate {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::CameraModel;

Vector3d part(const CameraModel& model, int index) {
  return std::visit(
      [index](const auto& m) -> Vector3d {
        using Model = std::decay_t<decltype(m)>;
        if (index == 0) return m.c;
        if (index == 1) return m.a;
        if (index == 2) return m.h;
        if (index == 3) return m.v;
        if constexpr (!std::is_same_v<Model, geometry::Cahv>) {
          if (index == 4) return m.o;
          if (index == 5) return m.r;
        }
        if constexpr (std::is_same_v<Model, geometry::Cahvore>) return m.e;
        return Vector3d::Zero();
      },
      model);
}

void set_part(CameraModel& model, int index, const Vector3d& value) {
  std::visit(
      [&](auto& m) {
        using Model = std::decay_t<decltype(m)>;
        if (index == 0) m.c = value;
        if (index == 1) m.a = value;
        if (index == 2) m.h = value;
        if (index == 3) m.v = value;
        if constexpr (!std::is_same_v<Model, geometry::Cahv>) {
          if (index == 4) m.o = value;
          if (index == 5) m.r = value;
        }
        if constexpr (std::is_same_v<Model, geometry::Cahvore>) {
          if (index == 6) m.e = value;
        }
      },
      model);
}

int parts(const CameraModel& model) {
  constexpr int kParts[] = {4, 6, 7};
  return kParts[model.index()];
}

MatrixXd vectors_by_pose(const CameraModel& model) {
  MatrixXd result = MatrixXd::Zero(3 * parts(model), 6);
  result.block<3, 3>(0, 3).setIdentity();
  for (int i = 0; i < parts(model); ++i) {
    if (!is_direction(i)) continue;
    const Vector3d v = part(model, i);
    for (int axis = 0; axis < 3; ++axis) {
      result.block<3, 1>(3 * i, axis) = Vector3d::Unit(axis).cross(v);
    }
  }
  return result;
}

MatrixXd pixel_by_vectors(const CameraModel& model, const Vector3d& point_m) {
  constexpr double kPart = 1e-6;
  MatrixXd result = MatrixXd::Zero(2, 3 * parts(model));
  for (int i = 0; i < parts(model); ++i) {
    const Vector3d at = part(model, i);
    const double step = kPart * std::max(1.0, at.norm());
    for (int axis = 0; axis < 3; ++axis) {
      CameraModel ahead = model;
      CameraModel behind = model;
      set_part(ahead, i, at + step * Vector3d::Unit(axis));
      set_part(behind, i, at - step * Vector3d::Unit(axis));
      Vector2d a;
      Vector2d b;
      if (geometry::project(ahead, point_m, a) != geometry::OpticsStatus::ok ||
          geometry::project(behind, point_m, b) != geometry::OpticsStatus::ok) {
        continue;
      }
      result.col(3 * i + axis) = (a - b) / (2.0 * step);
    }
  }
  return result;
}

}  // namespace dottrack::calibrate
