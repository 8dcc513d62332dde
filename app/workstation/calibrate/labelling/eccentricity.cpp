#include "app/workstation/calibrate/labelling/eccentricity.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace dottrack::calibrate {
namespace {

constexpr std::size_t kRim = 72;
constexpr double kFlat = 0.02;  // off the plane, of the neighbours' extent

std::optional<Eigen::Vector3d> normal_of(const Scene& scene, const SurveyIndex& survey, int dot) {
  constexpr std::size_t kEnough = 4;
  const SurveyedDot& d = scene.dots[static_cast<std::size_t>(dot)];
  if (d.normal) return d.normal;
  const std::vector<int>& near = survey.neighbours(dot);
  if (near.size() < kEnough) return std::nullopt;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < kEnough; ++i) {
    const auto other = static_cast<std::size_t>(near[i]);
    const Eigen::Vector3d off = scene.dots[other].position_m - d.position_m;
    scatter += off * off.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d& squares = solver.eigenvalues();
  if (!(squares[0] < kFlat * kFlat * squares[1]) || !(squares[1] > 0.05 * squares[2])) {
    return std::nullopt;
  }
  return solver.eigenvectors().col(0);
}

}  // namespace

Eigen::Vector2d eccentricity_px(const geometry::CameraModel& model, const Eigen::Vector3d& centre_m,
                                const Eigen::Vector3d& normal, double radius_m) {
  const Eigen::Vector2d none = Eigen::Vector2d::Zero();
  Eigen::Vector2d middle;
  if (geometry::project(model, centre_m, middle) != geometry::OpticsStatus::ok) return none;
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d w = normal.cross(u);
  std::array<Eigen::Vector2d, kRim> rim;
  for (std::size_t i = 0; i < kRim; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kRim;
    const Eigen::Vector3d at = centre_m + radius_m * (std::cos(angle) * u + std::sin(angle) * w);
    if (geometry::project(model, at, rim[i]) != geometry::OpticsStatus::ok) return none;
    rim[i] -= middle;
  }
  double twice_area = 0.0;
  Eigen::Vector2d moment = none;
  for (std::size_t i = 0; i < kRim; ++i) {
    const Eigen::Vector2d& a = rim[i];
    const Eigen::Vector2d& b = rim[(i + 1) % kRim];
    const double cross = a.x() * b.y() - a.y() * b.x();
    twice_area += cross;
    moment += cross * (a + b);
  }
  return std::abs(twice_area) > 1e-9 ? Eigen::Vector2d(moment / (3.0 * twice_area)) : none;
}

Eigen::Vector2d eccentricity_px(const Scene& scene, const SurveyIndex& survey,
                                const Growth& labelling, int dot) {
  const auto i = static_cast<std::size_t>(dot);
  const auto normal = normal_of(scene, survey, dot);
  if (!normal || labelling.labels[i] == kNoBlob) return Eigen::Vector2d::Zero();
  const SurveyedDot& d = scene.dots[i];
  const Sketch& s = labelling.sketch;
  const Blob& blob = scene.blobs[static_cast<std::size_t>(labelling.labels[i])];
  const double range_m = (d.position_m - s.place_m()).norm();
  const double radius_m =
      d.diameter_m > 0.0 ? 0.5 * d.diameter_m : blob.semi_major_px * range_m / s.focal_px;
  return eccentricity_px(as_cahvor(s), d.position_m, *normal, radius_m);
}

}  // namespace dottrack::calibrate
