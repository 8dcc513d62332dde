// What integrals along an outline say, against the pixels' own sums and finer integration.

#include "app/core/image/outline_integrals.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "app/core/image/shape_information.h"

namespace dottrack::image::test {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Parameters = ShapeInformation::Vector;
using Matrix = ShapeInformation::Matrix;

constexpr int kSide_px = 64;
constexpr double kPixels = kSide_px * kSide_px;

OutlineModel model_of(double major_px, double minor_px, double angle_rad, double blur_px) {
  OutlineModel model;
  model.centre = {31.8, 32.3};
  model.shape =
      ellipse_matrix(major_px, minor_px, std::cos(angle_rad), std::sin(angle_rad)).inverse();
  model.blur_px = blur_px;
  model.contrast_dn = 100.0;
  return model;
}

// The derivatives of a pixel's grey value that the fit goes by (outline_sums.h), for A's 11, 12 and
// 22, blur, contrast and background.
Parameters derivatives(const OutlineModel& model, const Vector2d& u) {
  const Vector2d g = model.shape * u;
  const double q = std::max(u.dot(g), 1e-9);
  const double h = std::sqrt(q / std::max(g.squaredNorm(), 1e-12));
  const double blur2 = model.blur_px * model.blur_px;
  const double curvature = model.shape.trace() - 1.0 / (h * h);
  const double m = std::sqrt(q + blur2 * curvature);
  const double z = h * (1.0 - m) / model.blur_px;
  const double p = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
  const double edge = model.contrast_dn / model.blur_px;
  const double by_form = -0.5 * edge * p * h / m;
  Parameters by;
  by << by_form * u.x() * u.x(), 2.0 * by_form * u.x() * u.y(), by_form * u.y() * u.y(),
      -edge * p * (z + h / m * model.blur_px * curvature),
      0.5 * std::erfc(-z / std::numbers::sqrt2), 1.0;
  return by;
}

Matrix summed(const OutlineModel& model) {
  Matrix sum = Matrix::Zero();
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = 0; x < kSide_px; ++x) {
      const Parameters by = derivatives(model, Vector2d(x, y) - model.centre);
      sum += by * by.transpose();
    }
  }
  return sum;
}

// The largest difference, in units of what the parameters' own information is.
double difference(const Matrix& a, const Matrix& b) {
  const Parameters per = b.diagonal().cwiseSqrt().cwiseInverse();
  return (per.asDiagonal() * (a - b) * per.asDiagonal()).cwiseAbs().maxCoeff();
}

TEST(OutlineIntegrals, ComeToThePixelsSums) {
  int compared = 0;
  double sum_of_usual = 0.0;
  for (const double radius : {2.0, 3.0, 4.0, 7.0, 10.0}) {
    for (const double ratio : {1.0, 0.7, 0.5}) {
      for (const double blur : {0.6, 0.71, 0.85}) {
        if (radius * ratio < 1.9) continue;
        const OutlineModel model = model_of(radius, radius * ratio, 0.4, blur);
        const Outline outline(model.shape);
        const ShapeInformation shape(model, outline, integrate(model, outline), kPixels, 0.0);
        const double off = difference(shape.information(), summed(model));
        // Sampling leaves a few parts in a hundred of narrow blur; of the smallest dots the middle,
        // where no outline is straight, is a part too.
        EXPECT_LT(off, radius * ratio < 2.2 ? 0.15 : 0.035)
            << radius << ' ' << ratio << ' ' << blur;
        if (blur > 0.7 && radius * ratio > 2.2) sum_of_usual += off;
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 36);
  EXPECT_LT(sum_of_usual / 22, 0.01);
}

TEST(OutlineIntegrals, TheCovarianceIsTheInverse) {
  for (const double blur : {0.5, 0.71, 1.2}) {
    const OutlineModel model = model_of(6.0, 4.0, -0.8, blur);
    const Outline outline(model.shape);
    const ShapeInformation shape(model, outline, integrate(model, outline), 400.0, 5.0);
    ASSERT_TRUE(shape.ok());
    const Matrix one = shape.information() * shape.covariance();
    EXPECT_LT((one - Matrix::Identity()).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(OutlineIntegrals, TheThirdHarmonicsAgreeWithFinerSteps) {
  const OutlineModel model = model_of(5.0, 3.2, 0.9, 0.7);
  const Outline outline(model.shape);
  const ThirdIntegrals coarse = integrate_thirds(outline);
  ThirdIntegrals fine;
  fine.place_place = fine.third_third = fine.third_normal = fine.third_place = Matrix2d::Zero();
  constexpr int kNodes = 4000;
  for (int i = 0; i < kNodes; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kNodes;
    const Vector2d u = outline.root * Vector2d(std::cos(angle), std::sin(angle));
    const Vector2d along = outline.root * Vector2d(-std::sin(angle), std::cos(angle));
    const double length = along.norm() * 2.0 * std::numbers::pi / kNodes;
    const Vector2d g = model.shape * u;
    const double h = 1.0 / g.norm();
    const Vector2d third(u.x() * u.x() * u.x() - 3.0 * u.x() * u.y() * u.y(),
                         3.0 * u.x() * u.x() * u.y() - u.y() * u.y() * u.y());
    fine.place_place += length * u * u.transpose();
    fine.third_third += length * h * h * third * third.transpose();
    fine.third_normal += length * h * third * g.normalized().transpose();
    fine.third_place += length * h * third * u.transpose();
  }
  EXPECT_LT((coarse.place_place - fine.place_place).norm(), 1e-3 * fine.place_place.norm());
  EXPECT_LT((coarse.third_third - fine.third_third).norm(), 1e-3 * fine.third_third.norm());
  EXPECT_LT((coarse.third_normal - fine.third_normal).norm(), 1e-3 * fine.third_normal.norm());
  EXPECT_LT((coarse.third_place - fine.third_place).norm(), 1e-3 * fine.third_place.norm());
}

}  // namespace
}  // namespace dottrack::image::test
