#include "app/config/camera_internal.h"

#include <Eigen/Geometry>
#include <cmath>

namespace dottrack::config {

using Eigen::Vector3d;

InternalModel internal_model(const Vector3d& a, const Vector3d& h, const Vector3d& v) {
  return {a.cross(h).norm(), a.dot(h), a.cross(v).norm(), a.dot(v),
          std::atan2(v.cross(h).dot(a), a.cross(v).dot(a.cross(h)))};
}

Eigen::Matrix<double, 5, 12> internal_jacobian(const Vector3d& a, const Vector3d& h,
                                               const Vector3d& v) {
  constexpr int kA = 3, kH = 6, kV = 9;
  const Vector3d ah = a.cross(h);
  const Vector3d av = a.cross(v);
  const double sine = v.cross(h).dot(a);
  const double cosine = av.dot(ah);
  Eigen::Matrix<double, 5, 12> j = Eigen::Matrix<double, 5, 12>::Zero();
  j.block<1, 3>(0, kA) = h.cross(ah).transpose() / ah.norm();
  j.block<1, 3>(0, kH) = ah.cross(a).transpose() / ah.norm();
  j.block<1, 3>(1, kA) = h.transpose();
  j.block<1, 3>(1, kH) = a.transpose();
  j.block<1, 3>(2, kA) = v.cross(av).transpose() / av.norm();
  j.block<1, 3>(2, kV) = av.cross(a).transpose() / av.norm();
  j.block<1, 3>(3, kA) = v.transpose();
  j.block<1, 3>(3, kV) = a.transpose();
  const Vector3d dsine_da = v.cross(h);
  const Vector3d dcosine_da = v.cross(ah) + h.cross(av);
  j.block<1, 3>(4, kA) = (cosine * dsine_da - sine * dcosine_da).transpose();
  j.block<1, 3>(4, kH) = (cosine * av - sine * av.cross(a)).transpose();
  j.block<1, 3>(4, kV) = (-cosine * ah - sine * ah.cross(a)).transpose();
  j.row(4) /= sine * sine + cosine * cosine;
  return j;
}

geometry::Cahv linear_part(const geometry::CameraModel& model) {
  return std::visit([](const auto& m) { return geometry::Cahv{m.c, m.a, m.h, m.v}; }, model);
}

}  // namespace dottrack::config
