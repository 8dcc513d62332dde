#include "app/workstation/calibrate/report/error_map.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/config/camera_internal.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kCells = 30;  // along the longer side

// The model with its n-th vector of C, A, H, V, O, R, E changed.
geometry::CameraModel changed(const geometry::CameraModel& model, int vector, const Vector3d& by) {
  geometry::CameraModel out = model;
  std::visit(
      [&](auto& m) {
        const std::array<Vector3d*, 4> linear{&m.c, &m.a, &m.h, &m.v};
        if (vector < 4) *linear[static_cast<std::size_t>(vector)] += by;
        if constexpr (requires { m.o; }) {
          if (vector == 4) m.o += by;
          if (vector == 5) m.r += by;
        }
        if constexpr (requires { m.e; }) {
          if (vector == 6) m.e += by;
        }
      },
      out);
  return out;
}

bool sees(const CameraCalibration& camera, const Vector3d& point_m, Vector2d& pixel,
          geometry::ProjectionJacobian& by_point) {
  return project(camera.model, point_m, pixel, &by_point) == geometry::OpticsStatus::ok &&
         pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < camera.width_px - 0.5 &&
         pixel.y() < camera.height_px - 0.5;
}

// d(pixel) / d(number of the model), by differences as small as the number's own uncertainty.
bool derivative(const CameraCalibration& camera, const Vector3d& point_m, int number,
                Vector2d& out) {
  const double sigma = std::sqrt(camera.covariance(number, number));
  if (!(sigma > 0.0)) {
    out.setZero();
    return true;
  }
  const double step = 0.01 * sigma;
  const Vector3d by = step * Vector3d::Unit(number % 3);
  Vector2d ahead;
  Vector2d behind;
  if (project(changed(camera.model, number / 3, by), point_m, ahead) !=
          geometry::OpticsStatus::ok ||
      project(changed(camera.model, number / 3, -by), point_m, behind) !=
          geometry::OpticsStatus::ok) {
    return false;
  }
  out = (ahead - behind) / (2.0 * step);
  return true;
}

using ByNumber = Eigen::Matrix<double, 2, Eigen::Dynamic>;

// d(pixel) / d(the model's vectors). False where the camera does not see the point.
bool derivatives(const CameraCalibration& camera, const Vector3d& point_m, ByNumber& by_number,
                 geometry::ProjectionJacobian& by_point) {
  Vector2d pixel;
  if (!sees(camera, point_m, pixel, by_point)) return false;
  const int count = static_cast<int>(camera.covariance.rows());
  by_number.resize(2, count);
  for (int i = 0; i < count; ++i) {
    Vector2d column;
    if (!derivative(camera, point_m, i, column)) return false;
    by_number.col(i) = column;
  }
  return true;
}

// A point triangulated from all cameras that see it.
class Triangulated {
 public:
  explicit Triangulated(const Calibration& calibration)
      : joint_(calibration.joint_covariance), pulls_(Pulls::Zero(3, joint_.rows())) {}

  // `first`: row of the camera's vectors in the joint covariance.
  void add(const CameraCalibration& camera, Eigen::Index first, const Vector3d& point_m) {
    ByNumber by_number;
    geometry::ProjectionJacobian by_point;
    if (!derivatives(camera, point_m, by_number, by_point)) return;
    const double noise_px2 = camera.image_sigma_px * camera.image_sigma_px;
    Eigen::Matrix2d covariance = by_number * camera.covariance * by_number.transpose();
    covariance.diagonal().array() += noise_px2;
    const Eigen::Matrix<double, 3, 2> weighed = by_point.transpose() * covariance.inverse();
    information_ += weighed * by_point;
    noise_ += noise_px2 * weighed * weighed.transpose();
    pulls_.middleCols(first, by_number.cols()) = weighed * by_number;
    ++cameras_;
  }

  std::size_t cameras() const { return cameras_; }
  // Root of the expected square; NaN from fewer than two cameras.
  double error_m() const {
    if (cameras_ < 2) return std::numeric_limits<double>::quiet_NaN();
    const Eigen::Matrix3d inverse = information_.inverse();
    const Eigen::Matrix3d together = noise_ + pulls_ * joint_ * pulls_.transpose();
    return std::sqrt((inverse * together * inverse).trace());
  }

 private:
  using Pulls = Eigen::Matrix<double, 3, Eigen::Dynamic>;

  const Eigen::MatrixXd& joint_;
  Pulls pulls_;
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d noise_ = Eigen::Matrix3d::Zero();
  std::size_t cameras_ = 0;
};

}  // namespace

Vector3d ErrorMap::middle(std::size_t column, std::size_t row) const {
  return {low_m.x() + step_m * (static_cast<double>(column) + 0.5),
          low_m.y() + step_m * (static_cast<double>(row) + 0.5), height_m};
}

double ErrorMap::worst_m() const {
  double worst = 0.0;
  for (const double e : error_m) worst = e > worst ? e : worst;
  return worst;
}

double ErrorMap::median_m() const {
  std::vector<double> seen;
  for (const double e : error_m) {
    if (std::isfinite(e)) seen.push_back(e);
  }
  if (seen.empty()) return 0.0;
  std::sort(seen.begin(), seen.end());
  return seen[seen.size() / 2];
}

bool model_covariance(const CameraCalibration& camera, const Vector3d& point_m,
                      Eigen::Matrix2d& covariance_px2, geometry::ProjectionJacobian& by_point) {
  ByNumber by_number;
  if (!derivatives(camera, point_m, by_number, by_point)) return false;
  covariance_px2 = by_number * camera.covariance * by_number.transpose();
  return true;
}

ErrorMap error_map(const Calibration& calibration, std::span<const SurveyedDot> dots,
                   double height_m) {
  ErrorMap map;
  map.height_m = height_m;
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;
  for (const SurveyedDot& dot : dots) {
    low = low.cwiseMin(dot.position_m.head<2>());
    high = high.cwiseMax(dot.position_m.head<2>());
  }
  const double longer = (high - low).maxCoeff();
  if (!(longer > 0.0)) return map;
  map.low_m = low;
  map.step_m = longer / static_cast<double>(kCells);
  const auto cells = [&](double length) {
    return std::max<std::size_t>(1,
                                 static_cast<std::size_t>(std::ceil(length / map.step_m - 1e-9)));
  };
  map.columns = cells(high.x() - low.x());
  map.rows = cells(high.y() - low.y());
  for (std::size_t row = 0; row < map.rows; ++row) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      Triangulated point(calibration);
      Eigen::Index first = 0;
      for (const CameraCalibration& camera : calibration.cameras) {
        point.add(camera, first, map.middle(column, row));
        first += camera.covariance.rows();
      }
      map.cameras.push_back(point.cameras());
      map.error_m.push_back(point.error_m());
    }
  }
  return map;
}

}  // namespace dottrack::calibrate
