#include "app/workstation/calibrate/labelling/sketch_start.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>

namespace dottrack::calibrate {
namespace {

constexpr double kFlat = 0.25;  // of the longest extent: flat enough to look alike from two sides
constexpr double kLine = 1e-3;  // of the longest extent: no plane
constexpr std::array kFocalLengths{0.6, 1.2, 2.5, 6.0, 15.0};  // of those believed in

struct Spread {
  Eigen::Vector3d middle;
  Eigen::Matrix3d axes;     // columns, right-handed: along, across, off the points' plane
  Eigen::Vector3d extents;  // standard deviations along these
};

Spread spread_of(std::span<const Eigen::Vector3d> points) {
  Spread spread;
  spread.middle.setZero();
  for (const auto& p : points) spread.middle += p;
  spread.middle /= static_cast<double>(points.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const auto& p : points) moments += (p - spread.middle) * (p - spread.middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments /
                                                              static_cast<double>(points.size()));
  spread.axes.col(0) = solver.eigenvectors().col(2);
  spread.axes.col(1) = solver.eigenvectors().col(1);
  spread.axes.col(2) = spread.axes.col(0).cross(spread.axes.col(1));
  spread.extents = solver.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt();
  return spread;
}

// Scaled orthography: rows of a rotation, times a scale.
struct FarView {
  Eigen::Matrix3d rotation;  // world to camera
  double px_per_m = 1.0;
};

Eigen::Matrix3d with_third_row(const Eigen::Matrix<double, 2, 3>& rows) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows.transpose(),
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::Matrix<double, 3, 2> upright = svd.matrixU() * svd.matrixV().transpose();
  Eigen::Matrix3d rotation;
  rotation.row(0) = upright.col(0).transpose();
  rotation.row(1) = upright.col(1).transpose();
  rotation.row(2) = rotation.row(0).cross(rotation.row(1));
  return rotation;
}

// A plane's 2 x 2 map is the left part of a scaled rotation: what its third column is follows, but
// for the sign.
void add_views_of_plane(const Eigen::Matrix2d& map, const Eigen::Matrix3d& axes,
                        std::vector<FarView>& views) {
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(map, Eigen::ComputeFullU);
  const double scale = svd.singularValues()[0];
  const double ratio = svd.singularValues()[1] / scale;
  const Eigen::Vector2d slant =
      svd.matrixU().col(1) * (scale * std::sqrt(std::max(0.0, 1.0 - ratio * ratio)));
  for (const double sign : {1.0, -1.0}) {
    Eigen::Matrix<double, 2, 3> rows;
    rows << map, sign * slant;
    views.push_back({with_third_row(rows * axes.transpose() / scale), scale});
  }
}

std::vector<FarView> far_rotations(std::span<const Eigen::Vector3d> points,
                                   std::span<const Eigen::Vector2d> pixels, const Spread& spread,
                                   const Eigen::Vector2d& middle_px) {
  Eigen::MatrixXd at(points.size(), 3);
  Eigen::MatrixXd seen(points.size(), 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    at.row(row) = (spread.axes.transpose() * (points[i] - spread.middle)).transpose();
    seen.row(row) = (pixels[i] - middle_px).transpose();
  }
  std::vector<FarView> views;
  if (spread.extents[2] < kFlat * spread.extents[0] || points.size() < 4) {
    const Eigen::Matrix2d map = at.leftCols<2>().colPivHouseholderQr().solve(seen).transpose();
    add_views_of_plane(map, spread.axes, views);
  }
  if (spread.extents[2] > 0.02 * spread.extents[0] && points.size() >= 4) {
    const Eigen::Matrix<double, 2, 3> map = at.colPivHouseholderQr().solve(seen).transpose();
    const double scale = std::sqrt(0.5 * map.squaredNorm());
    views.push_back({with_third_row(map * spread.axes.transpose() / scale), scale});
  }
  return views;
}

// The same view of the middle, as a camera of this focal length has it at the middle's pixel.
Sketch carried(const FarView& view, const Spread& spread, const Eigen::Vector2d& middle_px,
               double focal_px, const SketchPrior& prior) {
  Sketch s = prior.about;
  s.focal_px = focal_px;
  const Eigen::Vector2d off = (middle_px - s.centre_px) / focal_px;
  const Eigen::Vector3d towards = Eigen::Vector3d(off.x(), off.y() / s.aspect, 1.0);
  s.rotation =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), towards).toRotationMatrix() *
      view.rotation;
  s.translation_m = towards * (focal_px / view.px_per_m) - s.rotation * spread.middle;
  return s;
}

bool alike(const Sketch& a, const Sketch& b) {
  const Eigen::AngleAxisd between(Eigen::Matrix3d(a.rotation * b.rotation.transpose()));
  return between.angle() < 0.05 && std::abs(std::log(a.focal_px / b.focal_px)) < 0.2;
}

}  // namespace

std::vector<Sketch> far_views(std::span<const Eigen::Vector3d> points,
                              std::span<const Eigen::Vector2d> pixels, const SketchPrior& prior) {
  if (points.size() < 3) return {};
  const Spread spread = spread_of(points);
  if (!(spread.extents[1] > kLine * spread.extents[0])) return {};
  Eigen::Vector2d middle_px = Eigen::Vector2d::Zero();
  for (const auto& p : pixels) middle_px += p;
  middle_px /= static_cast<double>(pixels.size());
  std::vector<Sketch> starts;
  for (const FarView& view : far_rotations(points, pixels, spread, middle_px)) {
    if (!(view.px_per_m > 0.0) || !view.rotation.allFinite()) continue;
    for (const double factor : kFocalLengths) {
      starts.push_back(carried(view, spread, middle_px, factor * prior.about.focal_px, prior));
    }
  }
  return starts;
}

std::vector<SketchFit> sketches(std::span<const Eigen::Vector3d> points,
                                std::span<const Eigen::Vector2d> pixels, const SketchPrior& prior,
                                double scale_px, std::size_t keep) {
  std::vector<SketchFit> fits;
  for (const Sketch& start : far_views(points, pixels, prior)) {
    fits.push_back(fit_sketch(start, prior, points, pixels, scale_px));
  }
  std::stable_sort(fits.begin(), fits.end(),
                   [](const SketchFit& a, const SketchFit& b) { return a.cost < b.cost; });
  std::vector<SketchFit> best;
  for (const SketchFit& fit : fits) {
    if (best.size() == keep) break;
    const bool known = std::any_of(best.begin(), best.end(), [&](const SketchFit& other) {
      return alike(fit.sketch, other.sketch);
    });
    if (!known) best.push_back(fit);
  }
  return best;
}

}  // namespace dottrack::calibrate
