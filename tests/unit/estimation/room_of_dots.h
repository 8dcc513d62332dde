#pragma once
// Cameras round a vehicle and what they would see of its dots: centres without pictures.

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "app/core/estimation/pose_fit.h"
#include "tests/unit/acquisition/synthetic_views.h"

namespace dottrack::estimation::test {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Covariances that differ from dot to dot and lean: an ellipse's centre is known less well along
// it.
inline Matrix2d random_covariance(double sigma_px, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const double along = sigma_px * (0.7 + 0.8 * part(random));
  const double across = along * (0.5 + 0.5 * part(random));
  const Eigen::Rotation2Dd turn(3.14159 * part(random));
  return turn.toRotationMatrix() * Vector2d(along * along, across * across).asDiagonal() *
         turn.toRotationMatrix().transpose();
}

inline Vector2d random_error(const Matrix2d& covariance, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Vector2d deviate(normal(random), normal(random));
  return covariance.llt().matrixL() * deviate;
}

struct RoomOfDots {
  explicit RoomOfDots(std::size_t dots = 5) {
    for (const core::Camera& camera : acquisition::test::ceiling_cameras()) {
      rig.cameras.push_back(camera);
    }
    const std::array<Vector3d, 8> layout = {
        Vector3d(0.45, 0.30, 0.0),   Vector3d(-0.50, 0.25, 0.0), Vector3d(-0.35, -0.33, 0.05),
        Vector3d(0.30, -0.20, 0.0),  Vector3d(0.05, 0.42, 0.0),  Vector3d(0.60, -0.40, 0.02),
        Vector3d(-0.10, -0.05, 0.1), Vector3d(-0.62, -0.10, 0.0)};
    for (std::size_t i = 0; i < dots; ++i) rig.target.dots.push_back({layout[i], 0.1, {}});
  }

  geometry::RigidMotion somewhere() {
    std::uniform_real_distribution<double> part(-1.0, 1.0);
    geometry::RigidMotion pose;
    pose.translation_m = Vector3d(4.0 + 1.5 * part(random), 3.0 + part(random), 0.4);
    pose.rotation = Eigen::AngleAxisd(3.1 * part(random), Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(0.3 * part(random), Vector3d::UnitX());
    return pose;
  }

  // A step away: 2 cm and 2 degrees.
  geometry::RigidMotion near(const geometry::RigidMotion& pose) {
    std::normal_distribution<double> normal;
    Vector6d step;
    for (int i = 0; i < 6; ++i) step[i] = normal(random) * (i < 3 ? 0.02 : 0.035);
    return stepped(pose, step);
  }

  // Every camera of `seeing` sees every dot.
  DotObservations see(const geometry::RigidMotion& pose, double sigma_px,
                      std::span<const core::Camera> seeing) {
    DotObservations views;
    for (std::size_t camera = 0; camera < seeing.size(); ++camera) {
      for (std::size_t dot = 0; dot < rig.target.dots.size(); ++dot) {
        Vector2d pixel;
        const Vector3d place = pose * rig.target.dots[dot].position_m;
        if (geometry::project(seeing[camera].model, place, pixel) != geometry::OpticsStatus::ok) {
          continue;
        }
        const Matrix2d covariance = random_covariance(std::max(sigma_px, 1e-6), random);
        if (sigma_px > 0.0) pixel += random_error(covariance, random);
        views.push_back(
            {static_cast<std::uint8_t>(camera), static_cast<std::uint8_t>(dot), pixel, covariance});
      }
    }
    return views;
  }
  DotObservations see(const geometry::RigidMotion& pose, double sigma_px) {
    return see(pose, sigma_px, as_span(rig.cameras));
  }

  core::Rig rig;
  std::mt19937 random{11};
};

// How models may be wrong: the camera elsewhere, and turned about its vertical axis.
struct WrongModels {
  double shift_m = 0.0;  // standard deviation, each axis
  double turn_px = 0.0;

  void tell(core::Rig& rig) const {
    for (core::Camera& camera : rig.cameras) {
      geometry::Cahv wrong = std::get<geometry::Cahv>(camera.model);
      for (int axis = 0; axis < 3; ++axis) {
        wrong.c[axis] += shift_m;
        camera.model_errors.push_back(wrong);
        wrong.c[axis] -= shift_m;
      }
      wrong.h += turn_px * wrong.a;
      camera.model_errors.push_back(wrong);
    }
  }
  std::vector<core::Camera> draw(std::vector<core::Camera> cameras, std::mt19937& random) const {
    std::normal_distribution<double> normal;
    for (core::Camera& camera : cameras) {
      geometry::Cahv& model = std::get<geometry::Cahv>(camera.model);
      for (int axis = 0; axis < 3; ++axis) model.c[axis] += shift_m * normal(random);
      model.h += turn_px * normal(random) * model.a;
    }
    return cameras;
  }
};

inline Vector6d error_of(const core::Pose& pose, const geometry::RigidMotion& truth) {
  const Eigen::AngleAxisd turn(pose.orientation * truth.rotation.conjugate());
  Vector6d error;
  const double angle =
      turn.angle() > 3.14159265358979 ? turn.angle() - 6.28318530717959 : turn.angle();
  error << pose.position_m - truth.translation_m, angle * turn.axis();
  return error;
}

inline double nees(const core::Pose& pose, const geometry::RigidMotion& truth) {
  const Vector6d error = error_of(pose, truth);
  return error.dot(pose.covariance.ldlt().solve(error));
}

}  // namespace dottrack::estimation::test
