#pragma once
// The equations that the views of the dots put to a small step of the pose: linear, every row in
// units of its own standard deviation.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "app/core/estimation/dot_observation.h"
#include "app/core/estimation/small_step.h"
#include "app/core/rig.h"

namespace dottrack::estimation {

using Matrix26d = Eigen::Matrix<double, 2, 6>;

// residual = jacobian * step + noise of unit variance. The variance is that of the dot's centre and
// of the camera model at its place together; the latter is the same noise in all rows of a camera.
struct ViewRow {
  std::size_t camera = 0;
  std::size_t dot = 0;
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  Matrix26d jacobian = Matrix26d::Zero();
  Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();
  // What each of the camera's model errors would do to the row.
  StaticVector<Eigen::Vector2d, core::kMaxModelErrors> model_errors;

  // What the dot being off its place by a metre would do to the row, axis by axis.
  Eigen::Matrix<double, 2, 3> by_place = Eigen::Matrix<double, 2, 3>::Zero();

  double squared(const Vector6d& step) const { return (residual - jacobian * step).squaredNorm(); }
};

using ViewRows = StaticVector<ViewRow, kMaxCameras * core::kMaxDots>;

// When each camera took its picture, from the instant of the pose on, and how the vehicle moves
// meanwhile.
struct CaptureTimes {
  std::array<double, kMaxCameras> after_s{};
  Twist motion;
};

// How far each dot's outline is centred from where the dot's centre is shown
// (geometry::disc_eccentricity), view by view; zero where the target does not give its normal. It
// changes little with the pose: a step of a centimetre does not matter.
using Eccentricities = StaticVector<Eigen::Vector2d, kMaxCameras * core::kMaxDots>;
void find_eccentricities(const core::Rig& rig, std::span<const DotObservation> views,
                         const CaptureTimes& times, const geometry::RigidMotion& pose,
                         Eccentricities& offs_px);

// The rows about a pose. Observations in whose direction the lens shows nothing are left out.
void linearise(const core::Rig& rig, std::span<const DotObservation> views,
               const Eccentricities& offs_px, const CaptureTimes& times,
               const geometry::RigidMotion& pose, double dot_variance_m2, ViewRows& rows);

}  // namespace dottrack::estimation
