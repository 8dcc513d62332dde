#include "app/config/model_errors.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dottrack::config {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kLeast_px = 0.002;
constexpr int kColumns = 7;
constexpr int kRows = 5;

// C A H V [O R [E]], as in S.
void add_to(geometry::Cahv& m, const VectorXd& d) {
  m.c += d.segment<3>(0);
  m.a += d.segment<3>(3);
  m.h += d.segment<3>(6);
  m.v += d.segment<3>(9);
}
template <class Distorting>
void add_to_distorting(Distorting& m, const VectorXd& d) {
  m.c += d.segment<3>(0);
  m.a += d.segment<3>(3);
  m.h += d.segment<3>(6);
  m.v += d.segment<3>(9);
  m.o += d.segment<3>(12);
  m.r += d.segment<3>(15);
}
void add_to(geometry::Cahvor& m, const VectorXd& d) {
  add_to_distorting(m, d);
}
void add_to(geometry::Cahvore& m, const VectorXd& d) {
  add_to_distorting(m, d);
  m.e += d.segment<3>(18);
}

geometry::CameraModel moved(geometry::CameraModel model, const VectorXd& by) {
  std::visit([&](auto& m) { add_to(m, by); }, model);
  return model;
}

std::vector<Vector3d> places_seen(const core::Camera& camera) {
  std::vector<Vector3d> places;
  for (int i = 0; i < kColumns * kRows; ++i) {
    const int column = i % kColumns;
    const int row = i / kColumns;
    const Vector2d pixel((0.5 + column) * camera.width_px / kColumns,
                         (0.5 + row) * camera.height_px / kRows);
    geometry::Ray ray;
    if (geometry::unproject(camera.model, pixel, ray) != geometry::OpticsStatus::ok) continue;
    for (const double range_m : {camera.distance_min_m, camera.distance_max_m}) {
      places.push_back(ray.origin + range_m * ray.direction);
    }
  }
  return places;
}

// How a change of the model moves each place's picture, pixels; linear.
VectorXd effect(const core::Camera& camera, const std::vector<Vector3d>& places,
                const VectorXd& change) {
  VectorXd shift = VectorXd::Zero(2 * static_cast<Index>(places.size()));
  const geometry::CameraModel more = moved(camera.model, change);
  const geometry::CameraModel less = moved(camera.model, -change);
  for (std::size_t i = 0; i < places.size(); ++i) {
    Vector2d a;
    Vector2d b;
    if (geometry::project(more, places[i], a) == geometry::OpticsStatus::ok &&
        geometry::project(less, places[i], b) == geometry::OpticsStatus::ok) {
      shift.segment<2>(2 * static_cast<Index>(i)) = 0.5 * (a - b);
    }
  }
  return shift;
}

// Column by column of the vectors' numbers, in steps as small as these are uncertain.
MatrixXd effect_of_numbers(const core::Camera& camera, const std::vector<Vector3d>& places,
                           const MatrixXd& covariance) {
  constexpr double kPart = 0.01;
  MatrixXd out = MatrixXd::Zero(2 * static_cast<Index>(places.size()), covariance.cols());
  for (Index i = 0; i < covariance.cols(); ++i) {
    const double step = kPart * std::sqrt(std::max(covariance(i, i), 0.0));
    if (!(step > 0.0)) continue;
    out.col(i) = effect(camera, places, step * VectorXd::Unit(covariance.cols(), i)) / step;
  }
  return out;
}

// Columns whose outer products add up to the covariance.
MatrixXd root_of(const MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(covariance);
  const VectorXd sigmas = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return solver.eigenvectors() * sigmas.asDiagonal();
}

}  // namespace

MatrixXd set_model_errors(const MatrixXd& covariance, core::Camera& camera) {
  camera.model_errors.clear();
  MatrixXd readings(0, covariance.cols());
  const std::vector<Vector3d> places = places_seen(camera);
  if (places.empty()) return readings;
  const MatrixXd root = root_of(covariance);
  MatrixXd effects(2 * static_cast<Index>(places.size()), root.cols());
  for (Index i = 0; i < root.cols(); ++i) effects.col(i) = effect(camera, places, root.col(i));
  const MatrixXd by_number = effect_of_numbers(camera, places, covariance);
  const Eigen::JacobiSVD<MatrixXd> svd(effects, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const double least = kLeast_px * std::sqrt(static_cast<double>(places.size()));
  for (Index i = 0; i < svd.singularValues().size(); ++i) {
    const double size = svd.singularValues()[i];
    if (!(size > least)) break;
    const VectorXd change = root * svd.matrixV().col(i);
    if (!try_push_back(camera.model_errors, moved(camera.model, change))) break;
    readings.conservativeResize(readings.rows() + 1, Eigen::NoChange);
    readings.bottomRows<1>() = svd.matrixU().col(i).transpose() * by_number / size;
  }
  return readings;
}

}  // namespace dottrack::config
