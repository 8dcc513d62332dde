#pragma once
// A covariance in few bits that never claims more certainty than there is.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/protocol/layout_types.h"

namespace dottrack::protocol {

inline constexpr std::size_t kSigmas = 6;
inline constexpr std::size_t kCorrelations = 15;

// Which signals carry it: the six sigmas are alike, and so are the fifteen correlations.
struct CovarianceSignals {
  layout::Signal sigma;
  layout::Signal correlation;
};

// Raw numbers of the signals. Correlations are the upper triangle, row by row: xy xz ... pitch yaw.
struct RoundedCovariance {
  bool available = false;  // false: every number says "not available"
  std::array<std::uint64_t, kSigmas> sigmas{};
  std::array<std::uint64_t, kCorrelations> correlations{};
};

RoundedCovariance no_covariance(const CovarianceSignals& signals);

// The covariance as sent minus `covariance` is positive semidefinite, and so is the covariance as
// sent. Not available if a sigma is beyond its signal's range, or the matrix is no covariance: not
// finite, a variance not positive, not symmetric or not positive semidefinite, each but for what
// rounding does to a double.
//
// What is sent minus what is true is at most diag(1.01 sent^2 - true^2) of the sigmas with
// correlations in steps of 0.004 (2.1 % of the variances, and what rounding a sigma up by a step
// makes), at most diag(1.04 sent^2 - true^2) in steps of 0.016 (8.4 %).
RoundedCovariance round_covariance(const Eigen::Matrix<double, 6, 6>& covariance,
                                   const CovarianceSignals& signals);

}  // namespace dottrack::protocol
