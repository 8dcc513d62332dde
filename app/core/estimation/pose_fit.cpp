#include "app/core/estimation/pose_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace dottrack::estimation {
namespace {

constexpr int kMaxLinearisations = 5;
constexpr int kMaxWeighings = 4;  // while these views show the dots to be off by more
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
  // Of the models' errors, and per square metre of the dots', as if each row had its own.
  Matrix6d within_models = Matrix6d::Zero();
  Matrix6d within_dots = Matrix6d::Zero();
  std::array<ModelPulls, kMaxCameras> by_model;
  std::array<DotPulls, core::kMaxDots> by_dot;

  Sums() {
    for (ModelPulls& camera : by_model) camera.fill(Vector6d::Zero());
    by_dot.fill(DotPulls::Zero());
  }
  void add(const ViewRow& row) {
    information.noalias() += row.jacobian.transpose() * row.jacobian;
    const DotPulls by_place = row.jacobian.transpose() * row.by_place;
    within_dots.noalias() += by_place * by_place.transpose();
    by_dot[row.dot] += by_place;
    for (std::size_t i = 0; i < row.model_errors.size(); ++i) {
      const Vector6d pull = row.jacobian.transpose() * row.model_errors[i];
      within_models.noalias() += pull * pull.transpose();
      by_model[row.camera][i] += pull;
    }
  }
  // Each the same in all rows of its dot, per square metre.
  Matrix6d dots_together() const {
    Matrix6d sum = Matrix6d::Zero();
    for (const DotPulls& dot : by_dot) sum.noalias() += dot * dot.transpose();
    return sum;
  }
  // Each the same in all rows of its camera.
  Matrix6d models_together(const core::Rig& rig) const {
    Matrix6d sum = Matrix6d::Zero();
    for (const ModelPulls& camera : by_model) {
      for (const Vector6d& pull : camera) sum.noalias() += pull * pull.transpose();
    }
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

// Of the residuals: chance does not explain it.
bool is_too_large(double chi2, int freedom) {
  const double n = freedom;
  return freedom > 0 && chi2 > n + kUnlikely * std::sqrt(2.0 * n);
}

// 1, or how far the residuals are beyond chance.
double variance_factor(double chi2, int freedom) {
  return is_too_large(chi2, freedom) ? chi2 / freedom : 1.0;
}

// Variances of a dot's place, each coordinate: with which the views were weighed, and as it is.
struct PlaceVariance {
  double assumed_m2;
  double found_m2;
};

void set_covariance(const core::Rig& rig, const Sums& sums, const PlaceVariance& places,
                    PoseFit& result) {
  const Matrix6d inverse = sums.information.inverse();
  const double factor = variance_factor(result.chi2, result.coordinates - kPoseCoordinates);
  const Matrix6d together = sums.models_together(rig) + places.found_m2 * sums.dots_together();
  const Matrix6d random =
      sums.information - sums.within_models - places.assumed_m2 * sums.within_dots;
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
                              const geometry::RigidMotion& start, const DotSpread& spread,
                              PoseFit& result) {
  geometry::RigidMotion pose = start;
  double variance_m2 = place_variance_m2(spread.variance_m2());
  for (int weighing = 1;; ++weighing) {
    const PoseFitStatus status = solve(views, times, variance_m2, pose);
    if (status != PoseFitStatus::ok) return status;
    report(views, pose, spread, variance_m2, result);
    if (result.coordinates < kPoseCoordinates) return PoseFitStatus::degenerate;
    const double found_m2 = result.dot_sigma_m * result.dot_sigma_m;
    const bool dots_are_off =
        is_too_large(result.chi2, result.coordinates - kPoseCoordinates) && found_m2 > variance_m2;
    if (!dots_are_off || weighing == kMaxWeighings) return PoseFitStatus::ok;
    variance_m2 = found_m2;
  }
}

PoseFitStatus PoseFitter::solve(std::span<const DotObservation> views, const CaptureTimes& times,
                                double dot_variance_m2, geometry::RigidMotion& pose) {
  if (2 * views.size() < kPoseCoordinates) return PoseFitStatus::too_few_views;
  Vector6d step = Vector6d::Zero();
  double moved = kFar;
  std::size_t rows_before = 0;
  for (int i = 0; i < kMaxLinearisations; ++i) {
    if (moved >= kFar) find_eccentricities(*rig_, views, times, pose, offs_px_);
    linearise(*rig_, views, offs_px_, times, pose, dot_variance_m2, rows_);
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
  linearise(*rig_, views, offs_px_, times, pose, dot_variance_m2, rows_);
  test_views(as_span(rows_), Vector6d::Zero(), used_);
  return PoseFitStatus::ok;
}

// The rig file knows the least that it can be.
double PoseFitter::place_variance_m2(double learnt_m2) const {
  const double known_m = rig_->target.dot_sigma_m;
  return std::max(known_m * known_m, learnt_m2);
}

void PoseFitter::report(std::span<const DotObservation> views, const geometry::RigidMotion& pose,
                        const DotSpread& spread, double assumed_m2, PoseFit& result) {
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
    result.residuals.push_back({row.camera, row.dot, row.residual});
    result.cameras[row.camera].normal.add(row, 1.0);
    result.cameras[row.camera].coordinates += 2;
    result.coordinates += 2;
    result.chi2 += row.residual.squaredNorm();
  }
  for (auto& camera : result.cameras) camera.normal.mirror();
  if (result.coordinates < kPoseCoordinates) return;
  result.spread = spread_evidence(as_span(rows_), used_, sums.information, assumed_m2);
  const double found_m2 = place_variance_m2(spread.variance_with(result.spread));
  result.dot_sigma_m = std::sqrt(found_m2);
  set_covariance(*rig_, sums, {assumed_m2, found_m2}, result);
}

}  // namespace dottrack::estimation
