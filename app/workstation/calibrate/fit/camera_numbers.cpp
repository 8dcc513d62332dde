#include "app/workstation/calibrate/fit/camera_numbers.h"

#include <ceres/jet.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "app/config/camera_internal.h"
#include "app/workstation/calibrate/fit/numbered_projection.h"

namespace dottrack::calibrate {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

bool is_free(const LensKind& kind, int number) {
  if (number <= kSkew) return true;
  if (number == kAxis || number == kAxis + 1) return kind.own_axis;
  if (number == kRadial) return kind.form != LensForm::pinhole;
  if (number == kRadial + 1) return kind.two_radial;
  return kind.form == LensForm::pupil;
}

int count_free(const LensKind& kind) {
  int count = 0;
  for (int i = 0; i < kNumbers; ++i) count += is_free(kind, i) ? 1 : 0;
  return count;
}

namespace {

Vector3d three(const std::array<double, 21>& all, std::size_t from) {
  return {all[from], all[from + 1], all[from + 2]};
}

}  // namespace

geometry::CameraModel model_of(const NumberedCamera& camera) {
  const auto all = vectors_of(camera.frame, camera.numbers.data());
  const geometry::Cahv linear{three(all, 0), three(all, 3), three(all, 6), three(all, 9)};
  const Vector3d o = three(all, 12);
  const Vector3d r = three(all, 15);
  switch (camera.kind.form) {
    case LensForm::pinhole:
      return linear;
    case LensForm::radial:
      return geometry::Cahvor{linear.c, linear.a, linear.h, linear.v, o, r};
    case LensForm::pupil:
      break;
  }
  return geometry::Cahvore{linear.c, linear.a, linear.h,       linear.v,
                           o,        r,        three(all, 18), camera.kind.linearity};
}

NumberedCamera numbered(const geometry::CameraModel& model, ImageExtent extent, double distance_m,
                        const LensKind& kind) {
  const geometry::Cahv m = config::linear_part(model);
  const config::InternalModel internal = config::internal_model(m.a, m.h, m.v);
  NumberedCamera camera;
  camera.kind = kind;
  const Vector3d a = m.a.normalized();
  const Vector3d down = (m.v - a.dot(m.v) * a).normalized();
  camera.frame.rotation.row(0) = down.cross(a).transpose();
  camera.frame.rotation.row(1) = down.transpose();
  camera.frame.rotation.row(2) = a.transpose();
  camera.frame.centre_m = m.c;
  camera.frame.distance_m = distance_m;
  camera.frame.focal_px = internal.hs;
  camera.frame.middle_px = 0.5 * Vector2d(extent.width_px - 1, extent.height_px - 1);
  Numbers& n = camera.numbers;
  n[kAspect] = std::log(internal.vs / internal.hs);
  n[kCentre] = (internal.hc - camera.frame.middle_px.x()) / internal.hs;
  n[kCentre + 1] = (internal.vc - camera.frame.middle_px.y()) / internal.hs;
  if (kind.form == LensForm::pinhole) return camera;
  Vector3d o = a;
  Vector3d r = Vector3d::Zero();
  if (const auto* cahvor = std::get_if<geometry::Cahvor>(&model)) {
    o = cahvor->o;
    r = cahvor->r;
  } else if (const auto* cahvore = std::get_if<geometry::Cahvore>(&model)) {
    o = cahvore->o;
    r = cahvore->r;
    if (kind.form == LensForm::pupil) {
      n[kPupil] = cahvore->e.x() / distance_m;
      n[kPupil + 1] = cahvore->e.y() / distance_m;
    }
  }
  n[kRadial] = r.y();
  if (kind.two_radial) n[kRadial + 1] = r.z();
  const Vector3d own = camera.frame.rotation * o;
  if (kind.own_axis && own.z() > 0.0) {
    n[kAxis] = own.x() / own.z();
    n[kAxis + 1] = own.y() / own.z();
  }
  return camera;
}

void rebase(NumberedCamera& camera) {
  Numbers& n = camera.numbers;
  Matrix3d rotation;
  for (int i = 0; i < 3; ++i) {
    rotation.col(i) = turned(n.data() + kTurn, Vector3d(camera.frame.rotation.col(i)));
  }
  // Rounding does not add up.
  rotation.row(2).normalize();
  rotation.row(0) = rotation.row(1).cross(rotation.row(2)).normalized();
  rotation.row(1) = rotation.row(2).cross(rotation.row(0));
  camera.frame.rotation = rotation;
  camera.frame.centre_m +=
      camera.frame.distance_m * Vector3d(n[kPlace], n[kPlace + 1], n[kPlace + 2]);
  std::fill_n(n.begin(), kScale, 0.0);
}

Eigen::MatrixXd vectors_jacobian(const NumberedCamera& camera) {
  using Jet = ceres::Jet<double, kNumbers>;
  std::array<Jet, kNumbers> n;
  for (int i = 0; i < kNumbers; ++i) {
    n[static_cast<std::size_t>(i)] = Jet(camera.numbers[static_cast<std::size_t>(i)], i);
  }
  const auto all = vectors_of(camera.frame, n.data());
  const Eigen::Index rows = camera.kind.form == LensForm::pinhole  ? 12
                            : camera.kind.form == LensForm::radial ? 18
                                                                   : 21;
  Eigen::MatrixXd jacobian(rows, kNumbers);
  for (Eigen::Index i = 0; i < rows; ++i) {
    jacobian.row(i) = all[static_cast<std::size_t>(i)].v.transpose();
  }
  return jacobian;
}

std::optional<ViewLinear> linear_view(const NumberedCamera& camera, const Vector3d& point_m) {
  using Jet = ceres::Jet<double, kNumbers + 3>;
  std::array<Jet, kNumbers> n;
  for (int i = 0; i < kNumbers; ++i) {
    n[static_cast<std::size_t>(i)] = Jet(camera.numbers[static_cast<std::size_t>(i)], i);
  }
  Three<Jet> p;
  for (int i = 0; i < 3; ++i) p[i] = Jet(point_m[i], kNumbers + i);
  std::array<Jet, 2> pixel;
  if (!project_numbered(camera.frame, camera.kind, n.data(), p, pixel.data())) return std::nullopt;
  ViewLinear view;
  for (int i = 0; i < 2; ++i) {
    const Jet& at = pixel[static_cast<std::size_t>(i)];
    view.pixel[i] = at.a;
    view.by_numbers.row(i) = at.v.head<kNumbers>().transpose();
    view.by_point.row(i) = at.v.tail<3>().transpose();
  }
  return view;
}

}  // namespace dottrack::calibrate
