#include "app/core/tracking/shift_evidence.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "hal/base/static_vector.h"

namespace dottrack::tracking {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix26d = Eigen::Matrix<double, 2, 6>;

constexpr double kAlike_px = 0.4;  // what a camera's dots may differ by from their median
constexpr std::size_t kFewestDots = 2;

// A pose is known to a metre and a radian beforehand, however few the other cameras see.
constexpr double kPriorInformation = 1.0;

// The normal equations of a pose: translation, then rotation about the world axes through the
// vehicle's origin.
struct PoseEvidence {
  Matrix6d information = Matrix6d::Zero();
  Vector6d score = Vector6d::Zero();

  void add(const Matrix26d& jacobian, const Vector2d& residual_px) {
    information += jacobian.transpose() * jacobian;
    score += jacobian.transpose() * residual_px;
  }
  void add(const PoseEvidence& other) {
    information += other.information;
    score += other.score;
  }
  void remove(const PoseEvidence& other) {
    information -= other.information;
    score -= other.score;
  }
};

struct DotResidual {
  Vector2d residual_px;
  Matrix26d jacobian;
};

struct CameraResiduals {
  StaticVector<DotResidual, core::kMaxDots> dots;
  PoseEvidence used;  // of the dots that the pose rests on
};

DotResidual residual_of(const core::Pose& pose, const core::TargetDot& dot,
                        const estimation::Sighting& sighting) {
  const Vector3d lever = pose.orientation * dot.position_m;
  const Vector3d place = lever + pose.position_m;
  const double range_m = (place - sighting.line.ray.origin).dot(sighting.line.ray.direction);
  const geometry::ProjectionJacobian j = sighting.pixels_per_rad / range_m;
  DotResidual result;
  result.residual_px = sighting.pixel - sighting.pixel_of(place);
  result.jacobian.leftCols<3>() = j;
  for (int row = 0; row < 2; ++row) {
    result.jacobian.row(row).tail<3>() = lever.cross(Vector3d(j.row(row).transpose())).transpose();
  }
  return result;
}

double median(StaticVector<double, core::kMaxDots>& values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

Vector2d median_residual(const CameraResiduals& camera) {
  Vector2d result;
  for (int axis = 0; axis < 2; ++axis) {
    StaticVector<double, core::kMaxDots> values;
    for (const DotResidual& dot : camera.dots) values.push_back(dot.residual_px[axis]);
    result[axis] = median(values);
  }
  return result;
}

// `others`: what all cameras but this one say of the pose.
ShiftEvidence evidence_of(const CameraResiduals& camera, PoseEvidence others) {
  const Vector2d middle_px = median_residual(camera);
  std::size_t alike = 0;
  Vector2d sum_px = Vector2d::Zero();
  Matrix26d give = Matrix26d::Zero();
  for (const DotResidual& dot : camera.dots) {
    if ((dot.residual_px - middle_px).cwiseAbs().maxCoeff() > kAlike_px) continue;
    others.add(dot.jacobian, dot.residual_px);
    sum_px += dot.residual_px;
    give += dot.jacobian;
    ++alike;
  }
  ShiftEvidence evidence;
  if (alike < kFewestDots) return evidence;
  others.information.diagonal().array() += kPriorInformation;
  const Eigen::LLT<Matrix6d> factor(others.information);
  const Eigen::Matrix<double, 6, 2> back = factor.solve(give.transpose());
  evidence.information = static_cast<double>(alike) * Eigen::Matrix2d::Identity() - give * back;
  evidence.score = sum_px - back.transpose() * others.score;
  return evidence;
}

}  // namespace

std::array<ShiftEvidence, kMaxCameras> shift_evidence(const core::Rig& rig,
                                                      const Follower& follower,
                                                      const FollowResult& followed,
                                                      CameraSet distrusted) {
  std::array<CameraResiduals, kMaxCameras> cameras;
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
    for (std::size_t dot = 0; dot < rig.target.dots.size(); ++dot) {
      const estimation::Sighting* const sighting = follower.sighting(camera, dot);
      if (sighting == nullptr) continue;
      const DotResidual residual = residual_of(followed.pose, rig.target.dots[dot], *sighting);
      cameras[camera].dots.push_back(residual);
      if (followed.dots[dot].cameras.contains(camera) && !distrusted.contains(camera)) {
        cameras[camera].used.add(residual.jacobian, residual.residual_px);
      }
    }
  }
  PoseEvidence all;
  for (const CameraResiduals& camera : cameras) all.add(camera.used);
  std::array<ShiftEvidence, kMaxCameras> result;
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
    if (cameras[camera].dots.size() < kFewestDots) continue;
    PoseEvidence others = all;
    others.remove(cameras[camera].used);
    result[camera] = evidence_of(cameras[camera], others);
  }
  return result;
}

}  // namespace dottrack::tracking
