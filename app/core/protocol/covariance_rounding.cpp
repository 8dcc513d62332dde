#include "app/core/protocol/covariance_rounding.h"

#include <cmath>
#include <limits>

#include "app/core/protocol/rounding.h"

// Why what is sent is never below what is true. Let C be the covariance, h half a step of a
// correlation, s_i the sigmas as sent, S = diag(s_i), and T = S^-1 C S^-1. The sent correlations
// q_ij are T_ij to the nearest step: |q_ij - T_ij| <= h. What is sent minus C is S (Q - T) S, and Q
// - T has the diagonal 1 - C_ii / s_i^2. By Gershgorin it is positive semidefinite if each diagonal
// element is at least the sum of the five others in its row, hence if
//   1 - C_ii / s_i^2 >= 5 h,   that is   s_i >= sqrt(C_ii) sqrt(1 + e)   with   e = 5h / (1 - 5h).
// 1 + e/2 is above the root. Likewise Q - T <= (1 - C_ii / s_i^2 + 5h): the bound in the header.
// kTolerance adds to 5h what a matrix may lack of symmetry and definiteness, and the roundings of
// the arithmetic here and in the receiver. With T so close to semidefinite, Q is semidefinite, too.

namespace dottrack::protocol {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Sigmas = std::array<double, kSigmas>;

constexpr double kAsymmetry = 1e-9;   // of correlations
constexpr double kIndefinite = 1e-9;  // of the least eigenvalue of the matrix of correlations
constexpr double kTolerance = 1e-8;   // above 5 kAsymmetry + kIndefinite

constexpr double inflation(const layout::Signal& correlation) {
  const double share = 5.0 * (0.5 * correlation.factor) + kTolerance;
  return 1.0 + 0.5 * share / (1.0 - share);
}

// The comparisons here and below are such that NaN fails them.
bool take_sigmas(const Matrix6& c, double factor, const layout::Signal& signal, Sigmas& sigmas) {
  const double largest = static_cast<double>(signal.largest()) * signal.factor;
  for (int i = 0; i < 6; ++i) {
    if (!(c(i, i) >= std::numeric_limits<double>::min())) return false;
    const double sigma = std::sqrt(c(i, i));
    if (!(sigma * factor <= largest)) return false;
    sigmas[static_cast<std::size_t>(i)] = sigma;
  }
  return true;
}

bool symmetric(const Matrix6& c, const Sigmas& sigmas) {
  for (int j = 0; j < 6; ++j) {
    for (int i = j + 1; i < 6; ++i) {
      const double scale =
          sigmas[static_cast<std::size_t>(i)] * sigmas[static_cast<std::size_t>(j)];
      if (!(std::abs(c(i, j) - c(j, i)) <= kAsymmetry * scale)) return false;
    }
  }
  return true;
}

// By the pivots of elimination in the lower triangle. Adding the tolerance to a semidefinite matrix
// keeps every pivot that far above 0. One function a column: the compiler then keeps the triangle
// in registers, which takes half the time.
using Triangle = std::array<Sigmas, kSigmas>;

template <std::size_t kColumn>
bool eliminate(Triangle& a) {
  if constexpr (kColumn < kSigmas) {
    if (!(a[kColumn][kColumn] > 0.0)) return false;
    const double inverse = 1.0 / a[kColumn][kColumn];
    for (std::size_t k = kColumn + 1; k < kSigmas; ++k) {
      const double share = a[k][kColumn] * inverse;
      for (std::size_t i = k; i < kSigmas; ++i) a[i][k] -= share * a[i][kColumn];
    }
    return eliminate<kColumn + 1>(a);
  }
  return true;
}

bool semidefinite(const Matrix6& c) {
  Triangle a{};
  for (std::size_t i = 0; i < kSigmas; ++i) {
    for (std::size_t j = 0; j <= i; ++j) a[i][j] = c(static_cast<int>(i), static_cast<int>(j));
    a[i][i] *= 1.0 + kIndefinite;
  }
  return eliminate<0>(a);
}

}  // namespace

RoundedCovariance no_covariance(const CovarianceSignals& signals) {
  RoundedCovariance rounded;
  rounded.sigmas.fill(signals.sigma.not_available());
  rounded.correlations.fill(signals.correlation.not_available());
  return rounded;
}

RoundedCovariance round_covariance(const Matrix6& covariance, const CovarianceSignals& signals) {
  const double factor = inflation(signals.correlation);
  Sigmas sigmas{};
  const bool sendable = take_sigmas(covariance, factor, signals.sigma, sigmas) &&
                        symmetric(covariance, sigmas) && semidefinite(covariance);
  if (!sendable) return no_covariance(signals);

  RoundedCovariance rounded{.available = true, .sigmas = {}, .correlations = {}};
  Sigmas inverse{};  // of the sigmas as sent
  for (std::size_t i = 0; i < kSigmas; ++i) {
    const std::int64_t raw = rounded_up(signals.sigma, sigmas[i] * factor);
    rounded.sigmas[i] = static_cast<std::uint64_t>(raw);
    inverse[i] = 1.0 / (static_cast<double>(raw) * signals.sigma.factor);
  }
  std::size_t next = 0;
  for (std::size_t i = 0; i < kSigmas; ++i) {
    for (std::size_t j = i + 1; j < kSigmas; ++j) {
      const double element = covariance(static_cast<int>(j), static_cast<int>(i));
      rounded.correlations[next++] =
          raw_nearest(signals.correlation, element * inverse[i] * inverse[j]);
    }
  }
  return rounded;
}

}  // namespace dottrack::protocol
