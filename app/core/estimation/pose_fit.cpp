#include "app/core/estimation/pose_fit.h"

#include <Eigen/LU>
#include <cmath>

namespace dottrack::estimation {
namespace {

constexpr int kMaxLinearisations = 5;
// Metres and radians.
constexpr double kSmallStep = 1e-6;  // its square over the range is nothing
constexpr double kFar = 0.01;        // eccentricities are to be found anew
constexpr int kPoseCoordinates = 6;
constexpr double kUnlikely = 4.0;  // standard deviations of chi squared that chance may explain

// How errors that are the same in many rows move the pose, before the information is divided out.
using ModelPulls = std::array<Vector6d, core::kMaxModelErrors>;
using DotPulls = Eigen::Matrix<double, 6, 3>;

struct Sums {
  Matrix6d information = Matrix6d::Zero();
  Matrix6d within = Matrix6d::Zero();  // of these errors, as if each row had its own
  std::array<ModelPulls, kMaxCameras> by_model;
  std::array<DotPulls, core::kMaxDots> by_dot;

  Sums() {
    for (ModelPulls& camera : by_model) camera.fill(Vector6d::Zero());
    by_dot.fill(DotPulls::Zero());
  }
  void add(const ViewRow& row) {
    information.noalias() += row.jacobian.transpose() * row.jacobian;
    const DotPulls by_place = row.jacobian.transpose() * row.dot_errors;
    within.noalias() += by_place * by_place.transpose();
    by_dot[row.dot] += by_place;
    for (std::size_t i = 0; i < row.model_errors.size(); ++i) {
      const Vector6d pull = row.jacobian.transpose() * row.model_errors[i];
      within.noalias() += pull * pull.transpose();
      by_model[row.camera][i] += pull;
    }
  }
  // Each the same in all rows of its camera or dot.
  Matrix6d together(const core::Rig& rig) const {
    Matrix6d sum = Matrix6d::Zero();
    for (const ModelPulls& camera : by_model) {
      for (const Vector6d& pull : camera) sum.noalias() += pull * pull.transpose();
    }
    for (const DotPulls& dot : by_dot) sum.noalias() += dot * dot.transpose();
    if (!rig.model_correlations.known()) return sum;
    const Matrix6d half = among_cameras(rig);
    return sum + half + half.transpose();
  }
  // What the models' errors of different cameras have in common, of each pair one way round.
  Matrix6d among_cameras(const core::Rig& rig) const {
    Matrix6d sum = Matrix6d::Zero();
    for (std::size_t a = 0; a < rig.cameras.size(); ++a) {
      for (std::size_t i = 0; i < rig.cameras[a].model_errors.size(); ++i) {
        sum.noalias() += by_model[a][i] * of_cameras_before(rig, {a, i}).transpose();
      }
    }
    return sum;
  }
  Vector6d of_cameras_before(const core::Rig& rig, const core::ModelErrorIndex& error) const {
    Vector6d sum = Vector6d::Zero();
    for (std::size_t b = 0; b < error.camera; ++b) {
      for (std::size_t j = 0; j < rig.cameras[b].model_errors.size(); ++j) {
        sum += rig.model_correlations(error, {b, j}) * by_model[b][j];
      }
    }
    return sum;
  }
};

// 1, or how far the residuals are beyond chance.
double variance_factor(double chi2, int freedom) {
  if (freedom <= 0) return 1.0;
  const double n = freedom;
  return chi2 > n + kUnlikely * std::sqrt(2.0 * n) ? chi2 / n : 1.0;
}

void set_covariance(const core::Rig& rig, const Sums& sums, PoseFit& result) {
  const Matrix6d inverse = sums.information.inverse();
  const double factor = variance_factor(result.chi2, result.coordinates - kPoseCoordinates);
  const Matrix6d together = sums.together(rig);
  const Matrix6d random = sums.information - sums.within;
  result.systematic = factor * (inverse * together * inverse);
  for (CameraEvidence& camera : result.cameras) camera.normal.scale(1.0 / factor);
  const Matrix6d covariance = factor * (inverse * (random + together) * inverse);
  result.pose.covariance = 0.5 * (covariance + covariance.transpose());
}

FittedView fitted(const ViewRow& row, bool used) {
  return {used, row.residual_px.norm(), std::sqrt(0.5 * row.residual.squaredNorm())};
}

}  // namespace

PoseFitStatus PoseFitter::fit(std::span<const DotObservation> views, const CaptureTimes& times,
                              const geometry::RigidMotion& start, PoseFit& result) {
  if (2 * views.size() < kPoseCoordinates) return PoseFitStatus::too_few_views;
  geometry::RigidMotion pose = start;
  Vector6d step = Vector6d::Zero();
  double moved = kFar;
  std::size_t rows_before = 0;
  for (int i = 0; i < kMaxLinearisations; ++i) {
    if (moved >= kFar) find_eccentricities(*rig_, views, times, pose, offs_px_);
    linearise(*rig_, views, offs_px_, times, pose, rows_);
    if (2 * rows_.size() < kPoseCoordinates) return PoseFitStatus::too_few_views;
    const bool again = moved < kFar && rows_.size() == rows_before;
    rows_before = rows_.size();
    if (!(again ? repeated_step : robust_step)(as_span(rows_), step, used_)) {
      return PoseFitStatus::degenerate;
    }
    pose = stepped(pose, step);
    moved = step.cwiseAbs().maxCoeff();
    if (moved < kSmallStep) break;
  }
  linearise(*rig_, views, offs_px_, times, pose, rows_);
  test_views(as_span(rows_), Vector6d::Zero(), used_);
  report(views, pose, result);
  return result.coordinates < kPoseCoordinates ? PoseFitStatus::degenerate : PoseFitStatus::ok;
}

void PoseFitter::report(std::span<const DotObservation> views, const geometry::RigidMotion& pose,
                        PoseFit& result) {
  result = PoseFit{};
  result.pose.position_m = pose.translation_m;
  result.pose.orientation = pose.rotation;
  result.views.resize(views.size());
  Sums sums;
  std::size_t view = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ViewRow& row = rows_[i];
    while (views[view].camera != row.camera || views[view].dot != row.dot) ++view;
    result.views[view] = fitted(row, used_[i]);
    if (!used_[i]) continue;
    sums.add(row);
    result.cameras[row.camera].normal.add(row, 1.0);
    result.cameras[row.camera].coordinates += 2;
    result.coordinates += 2;
    result.chi2 += row.residual.squaredNorm();
  }
  for (auto& camera : result.cameras) camera.normal.mirror();
  if (result.coordinates >= kPoseCoordinates) set_covariance(*rig_, sums, result);
}

}  // namespace dottrack::estimation
