#pragma once
// Covariances of every kind: full, singular, with correlations close to one, tiny and large.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>

namespace dottrack::protocol::test {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

inline Vector6 random_normal6(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Vector6 v;
  for (int i = 0; i < 6; ++i) v[i] = normal(random);
  return v;
}

// Of the rank asked for; `spread` lets the directions differ in size by so many powers of ten.
inline Matrix6 random_correlations(std::mt19937_64& random, int rank, double spread) {
  std::uniform_real_distribution<double> exponent(-spread, 0.0);
  Matrix6 c = Matrix6::Zero();
  for (int k = 0; k < rank; ++k) {
    const Vector6 v = random_normal6(random) * std::pow(10.0, exponent(random));
    c += v * v.transpose();
  }
  const Vector6 inverse = c.diagonal().cwiseSqrt().cwiseInverse();
  return inverse.asDiagonal() * c * inverse.asDiagonal();
}

inline Matrix6 scaled_covariance(const Matrix6& correlations, const Vector6& sigmas) {
  const Matrix6 c = sigmas.asDiagonal() * correlations * sigmas.asDiagonal();
  return 0.5 * (c + c.transpose());
}

// Sigmas from a nanometre to 0.3 m, and so in radians.
inline Matrix6 random_covariance(std::mt19937_64& random) {
  std::uniform_real_distribution<double> exponent(-9.0, std::log10(0.3));
  const int rank = 1 + static_cast<int>(random() % 8);
  const double spread = static_cast<double>(random() % 8);
  Vector6 sigmas;
  const double common = exponent(random);
  const bool alike = random() % 2 == 0;
  for (int i = 0; i < 6; ++i) sigmas[i] = std::pow(10.0, alike ? common : exponent(random));
  return scaled_covariance(random_correlations(random, rank, spread), sigmas);
}

}  // namespace dottrack::protocol::test
