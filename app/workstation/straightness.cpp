#include "app/workstation/straightness.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dottrack::workstation {
namespace {

using Eigen::Vector3d;

Vector3d mean_of(std::span<const Vector3d> points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// Along which the points spread most.
Vector3d direction_of(std::span<const Vector3d> points, const Vector3d& mean) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vector3d& p : points) scatter += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  return solver.eigenvectors().col(2);
}

}  // namespace

Straightness straightness_of(std::span<const Vector3d> positions_m) {
  Straightness result;
  if (positions_m.size() < 3) return result;
  const Vector3d mean = mean_of(positions_m);
  const Vector3d along = direction_of(positions_m, mean);
  const Vector3d level = Vector3d::UnitZ().cross(along).normalized();
  const Vector3d upright = along.cross(level);
  for (const Vector3d& p : positions_m) {
    const double h = level.dot(p - mean);
    const double v = upright.dot(p - mean);
    result.horizontal_rms_m += h * h;
    result.vertical_rms_m += v * v;
    result.max_m = std::max(result.max_m, std::hypot(h, v));
  }
  result.points = positions_m.size();
  const auto count = static_cast<double>(result.points);
  result.rms_m = std::sqrt((result.horizontal_rms_m + result.vertical_rms_m) / count);
  result.horizontal_rms_m = std::sqrt(result.horizontal_rms_m / count);
  result.vertical_rms_m = std::sqrt(result.vertical_rms_m / count);
  return result;
}

Straightness together(std::span<const Straightness> runs) {
  Straightness sum;
  const auto add = [](double& total, double rms, std::size_t points) {
    total += rms * rms * static_cast<double>(points);
  };
  for (const Straightness& run : runs) {
    add(sum.horizontal_rms_m, run.horizontal_rms_m, run.points);
    add(sum.vertical_rms_m, run.vertical_rms_m, run.points);
    add(sum.rms_m, run.rms_m, run.points);
    sum.max_m = std::max(sum.max_m, run.max_m);
    sum.points += run.points;
  }
  if (sum.points == 0) return sum;
  const auto count = static_cast<double>(sum.points);
  for (double* square : {&sum.horizontal_rms_m, &sum.vertical_rms_m, &sum.rms_m}) {
    *square = std::sqrt(*square / count);
  }
  return sum;
}

}  // namespace dottrack::workstation
