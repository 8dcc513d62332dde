#include "app/workstation/truth_record.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/telemetry/pose_files.h"

namespace dottrack::workstation {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& q) {
  const Eigen::AngleAxisd turn(q);
  return turn.angle() * turn.axis();
}

// Scaled to a unit diagonal first: metres and radians differ by orders of magnitude.
double normalised_square(const Vector6& error, const Eigen::Matrix<double, 6, 6>& covariance) {
  const Vector6 sigma = covariance.diagonal().cwiseSqrt();
  if (!(sigma.minCoeff() > 0.0) || !sigma.allFinite()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Vector6 inverse = sigma.cwiseInverse();
  const Eigen::Matrix<double, 6, 6> scaled =
      inverse.asDiagonal() * covariance * inverse.asDiagonal();
  const Eigen::LLT<Eigen::Matrix<double, 6, 6>> factor(scaled);
  if (factor.info() != Eigen::Success) return std::numeric_limits<double>::quiet_NaN();
  return factor.matrixL().solve(inverse.cwiseProduct(error)).squaredNorm();
}

}  // namespace

double PoseError::attitude_deg() const {
  return 180.0 / std::numbers::pi * rotation_rad.norm();
}

bool PoseError::wrong_lock() const {
  return !(position_mm() <= kWrongLock_mm && attitude_deg() <= kWrongLock_deg);
}

PoseError error_of(const core::Pose& pose, const TruePose& truth) {
  PoseError error;
  error.position_m = pose.position_m - truth.position_m;
  Eigen::Quaterniond turn = pose.orientation * truth.orientation.conjugate();
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  error.rotation_rad = rotation_vector(turn);
  Vector6 all;
  all << error.position_m, error.rotation_rad;
  error.nees = normalised_square(all, pose.covariance);
  return error;
}

Accuracy accuracy_of(std::span<const TruthRow> rows) {
  Accuracy sum;
  for (const TruthRow& row : rows) {
    if (row.wrong_lock()) ++sum.wrong_lock_ticks;
    if (!row.error) continue;
    ++sum.compared;
    const double off_mm = row.error->position_mm();
    const double off_deg = row.error->attitude_deg();
    sum.position_rms_mm += off_mm * off_mm;
    sum.attitude_rms_deg += off_deg * off_deg;
    sum.position_max_mm = std::max(sum.position_max_mm, off_mm);
    sum.attitude_max_deg = std::max(sum.attitude_max_deg, off_deg);
    sum.nees_mean += row.error->nees;
  }
  if (sum.compared == 0) return sum;
  const auto count = static_cast<double>(sum.compared);
  sum.position_rms_mm = std::sqrt(sum.position_rms_mm / count);
  sum.attitude_rms_deg = std::sqrt(sum.attitude_rms_deg / count);
  sum.nees_mean /= count;
  return sum;
}

FilterAccuracy filter_accuracy_of(std::span<const TruthRow> rows) {
  FilterAccuracy sum;
  for (const TruthRow& row : rows) {
    if (!row.filtered_error) continue;
    ++sum.compared;
    const double off_mm = row.filtered_error->position_mm();
    const double off_deg = row.filtered_error->attitude_deg();
    sum.position_rms_mm += off_mm * off_mm;
    sum.attitude_rms_deg += off_deg * off_deg;
    sum.position_max_mm = std::max(sum.position_max_mm, off_mm);
    sum.nees_mean += row.filtered_error->nees;
    if (!row.coasting) continue;
    ++sum.coasting_ticks;
    sum.coasting_rms_mm += off_mm * off_mm;
  }
  if (sum.compared == 0) return sum;
  const auto count = static_cast<double>(sum.compared);
  sum.position_rms_mm = std::sqrt(sum.position_rms_mm / count);
  sum.attitude_rms_deg = std::sqrt(sum.attitude_rms_deg / count);
  sum.nees_mean /= count;
  if (sum.coasting_ticks > 0) {
    sum.coasting_rms_mm = std::sqrt(sum.coasting_rms_mm / static_cast<double>(sum.coasting_ticks));
  }
  return sum;
}

void TruthRecord::do_write(const telemetry::CycleRecord& record) {
  TruthRow row;
  row.tick = record.result.tick;
  row.time_s = to_seconds(record.stamp.time_since_epoch());
  row.has_pose = record.result.has_pose;
  row.reason = record.result.reason;
  row.truth = truth_(record.stamp);
  row.cameras_used = record.result.cameras_used.size();
  row.dots_used = record.result.dots_used;
  row.cycle = record.stages.cycle();
  if (row.truth) write_line(record.stamp, *row.truth);
  if (row.has_pose) {
    row.position_m = record.result.pose.position_m;
    if (row.truth) row.error = error_of(record.result.pose, *row.truth);
  }
  const core::FilteredPose& filtered = record.result.filtered;
  row.coasting = filtered.coasting;
  if (filtered.known && row.truth) row.filtered_error = error_of(filtered.pose, *row.truth);
  rows_.push_back(row);
}

void TruthRecord::write_line(Time stamp, const TruePose& truth) {
  file_.write(telemetry::tum_line(stamp, truth.position_m, truth.orientation));
}

}  // namespace dottrack::workstation
