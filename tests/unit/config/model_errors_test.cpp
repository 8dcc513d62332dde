#include "app/config/model_errors.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace dottrack::config {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

core::Camera camera() {
  geometry::Cahvor model;
  model.c = {0.0, 0.0, 5.0};
  model.a = Vector3d(0.6, 0.1, -0.8).normalized();
  const Vector3d right = model.a.cross(Vector3d::UnitZ()).normalized();
  const Vector3d down = model.a.cross(right);
  model.h = 500.0 * right + 320.0 * model.a;
  model.v = 500.0 * down + 240.0 * model.a;
  model.o = model.a;
  model.r = {0.001, -0.05, 0.01};
  core::Camera camera;
  camera.model = model;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.distance_min_m = 2.0;
  camera.distance_max_m = 12.0;
  return camera;
}

// A calibration from many dots: all vectors a little uncertain, and not independently.
MatrixXd some_covariance() {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  MatrixXd root(18, 18);
  const double sigmas[6] = {3e-4, 5e-5, 0.03, 0.03, 5e-5, 2e-4};
  for (int i = 0; i < 18; ++i) {
    for (int j = 0; j < 18; ++j) root(i, j) = sigmas[i / 3] * normal(random) / 4.0;
  }
  return root * root.transpose();
}

VectorXd parameters(const geometry::Cahvor& m) {
  VectorXd p(18);
  p << m.c, m.a, m.h, m.v, m.o, m.r;
  return p;
}

geometry::Cahvor model_of(const VectorXd& p) {
  geometry::Cahvor m;
  m.c = p.segment<3>(0);
  m.a = p.segment<3>(3);
  m.h = p.segment<3>(6);
  m.v = p.segment<3>(9);
  m.o = p.segment<3>(12);
  m.r = p.segment<3>(15);
  return m;
}

// d(pixel)/d(parameters) by differences, carried through the covariance.
Eigen::Matrix2d propagated(const core::Camera& camera, const MatrixXd& covariance,
                           const Vector3d& place) {
  const VectorXd p = parameters(std::get<geometry::Cahvor>(camera.model));
  Eigen::Matrix<double, 2, 18> j;
  for (int i = 0; i < 18; ++i) {
    const double step = 1e-6 * std::max(1.0, std::abs(p[i]));
    Vector2d more;
    Vector2d less;
    EXPECT_EQ(project(model_of(p + step * VectorXd::Unit(18, i)), place, more),
              geometry::OpticsStatus::ok);
    EXPECT_EQ(project(model_of(p - step * VectorXd::Unit(18, i)), place, less),
              geometry::OpticsStatus::ok);
    j.col(i) = (more - less) / (2.0 * step);
  }
  return j * covariance * j.transpose();
}

TEST(ModelErrors, TogetherMakeTheModelsCovarianceOfEveryPixel) {
  core::Camera c = camera();
  const MatrixXd covariance = some_covariance();
  set_model_errors(covariance, c);
  ASSERT_GE(c.model_errors.size(), 4U);
  for (int i = 0; i < 12; ++i) {
    geometry::Ray ray;
    const Vector2d pixel(40.0 + 50.0 * i, 30.0 + 37.0 * ((5 * i) % 12));
    ASSERT_EQ(geometry::unproject(c.model, pixel, ray), geometry::OpticsStatus::ok);
    const Vector3d place = ray.origin + (2.5 + 0.7 * i) * ray.direction;
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (const geometry::CameraModel& wrong : c.model_errors) {
      Vector2d shown;
      ASSERT_EQ(geometry::project(wrong, place, shown), geometry::OpticsStatus::ok);
      sum += (shown - pixel) * (shown - pixel).transpose();
    }
    const Eigen::Matrix2d truth = propagated(c, covariance, place);
    EXPECT_GT(std::sqrt(truth.trace()), 0.02);
    EXPECT_LT((sum - truth).norm(), 0.03 * truth.norm()) << i;
  }
}

TEST(ModelErrors, OfAnExactModelThereAreNone) {
  core::Camera c = camera();
  set_model_errors(MatrixXd::Zero(18, 18), c);
  EXPECT_TRUE(c.model_errors.empty());
  set_model_errors(1e-14 * MatrixXd::Identity(18, 18), c);
  EXPECT_TRUE(c.model_errors.empty());
}

}  // namespace
}  // namespace dottrack::config
