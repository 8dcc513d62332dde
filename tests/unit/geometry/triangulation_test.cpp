#include "app/core/geometry/triangulation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <random>
#include <vector>

namespace dottrack::geometry {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::vector<SightLine> lines_to(const Vector3d& point, const std::vector<Vector3d>& origins) {
  std::vector<SightLine> lines;
  lines.reserve(origins.size());
  for (const Vector3d& origin : origins) {
    lines.push_back({{origin, (point - origin).normalized()}, 1e-3});
  }
  return lines;
}

const std::vector<Vector3d> kCorners = {
    {0.0, 0.0, 5.0}, {8.0, 0.0, 5.0}, {0.0, 6.0, 5.0}, {8.0, 6.0, 4.5}};

// The appendix's own coefficients, spelled out with their fourth powers.
Vector3d appendix_solution(const std::vector<SightLine>& lines,
                           const std::vector<double>& weights) {
  Matrix3d c = Matrix3d::Zero();
  Vector3d e = Vector3d::Zero();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Vector3d& u = lines[i].ray.direction;
    Matrix3d ci;
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) {
        // (1/2) d(d^2)/dp_j, coefficient of p_k: sum over the components m of d.
        double sum = 0.0;
        for (int m = 0; m < 3; ++m) {
          const double dm_dpk = u[k] * u[m] - (m == k ? 1.0 : 0.0);
          const double dm_dpj = u[j] * u[m] - (m == j ? 1.0 : 0.0);
          sum += dm_dpk * dm_dpj;
        }
        ci(j, k) = sum;
      }
    }
    c += weights[i] * ci;
    e -= weights[i] * ci * lines[i].ray.origin;
  }
  return -c.inverse() * e;
}

TEST(Triangulation, FindsTheCommonPoint) {
  const Vector3d point(3.0, 2.0, 0.4);
  const auto lines = lines_to(point, kCorners);
  Triangulation result;
  ASSERT_EQ(triangulate(lines, result), TriangulationStatus::ok);
  EXPECT_NEAR((result.point_m - point).norm(), 0.0, 1e-12);
  EXPECT_NEAR(result.rms_miss_m, 0.0, 1e-12);
}

TEST(Triangulation, IsTheAppendixWithInverseSquareRangeWeights) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 0.003);
  for (int trial = 0; trial < 200; ++trial) {
    auto lines = lines_to({4.0, 1.0, 0.3}, kCorners);
    for (SightLine& line : lines) {
      line.ray.direction += Vector3d(noise(random), noise(random), noise(random));
      line.ray.direction.normalize();
    }
    const Vector3d first = appendix_solution(lines, {1.0, 1.0, 1.0, 1.0});
    std::vector<double> weights;
    weights.reserve(lines.size());
    for (const SightLine& line : lines) {
      weights.push_back(1.0 / (first - line.ray.origin).squaredNorm());
    }
    Triangulation result;
    ASSERT_EQ(triangulate(lines, result), TriangulationStatus::ok);
    EXPECT_NEAR((result.point_m - appendix_solution(lines, weights)).norm(), 0.0, 1e-10);
    EXPECT_GT(result.rms_miss_m, 0.0);
  }
}

TEST(Triangulation, CovarianceIsWhatNoiseDoes) {
  const Vector3d point(5.0, 3.0, 0.2);
  const double sigma = 1e-3;
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, sigma);
  Matrix3d sum = Matrix3d::Zero();
  Triangulation result;
  constexpr int kTrials = 20000;
  for (int trial = 0; trial < kTrials; ++trial) {
    auto lines = lines_to(point, kCorners);
    for (SightLine& line : lines) {
      line.sigma_rad = sigma;
      const Vector3d across = line.ray.direction.unitOrthogonal();
      line.ray.direction +=
          noise(random) * across + noise(random) * line.ray.direction.cross(across);
      line.ray.direction.normalize();
    }
    ASSERT_EQ(triangulate(lines, result), TriangulationStatus::ok);
    sum += (result.point_m - point) * (result.point_m - point).transpose();
  }
  const Matrix3d seen = sum / kTrials;
  EXPECT_LT((seen - result.covariance_m2).norm(), 0.05 * seen.norm());
}

TEST(Triangulation, RefusesTooFewAndParallelLines) {
  Triangulation result;
  const auto lines = lines_to({1.0, 1.0, 0.0}, kCorners);
  EXPECT_EQ(triangulate({lines.data(), 1}, result), TriangulationStatus::too_few_lines);
  const std::vector<SightLine> parallel = {{{Vector3d::Zero(), Vector3d::UnitZ()}, 1e-3},
                                           {{Vector3d::UnitX(), Vector3d::UnitZ()}, 1e-3},
                                           {{Vector3d::UnitY(), Vector3d::UnitZ()}, 1e-3}};
  EXPECT_EQ(triangulate(parallel, result), TriangulationStatus::degenerate);
}

}  // namespace
}  // namespace dottrack::geometry
