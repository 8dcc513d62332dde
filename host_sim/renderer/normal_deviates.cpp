#include "host_sim/renderer/normal_deviates.h"

#include <cmath>
#include <memory>

#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

constexpr double kStep = 1.0 / 2048.0;  // linear in between, which is good to 1e-7
constexpr std::size_t kHalf = NormalDeviates{}.size() / 2;

double density(double z) {
  return exponential(-0.5 * z * z) / std::sqrt(2.0 * kPi);
}

// The density's integral over [z, z + kStep], by Simpson's rule.
double share_of_step(double z) {
  return (density(z) + 4.0 * density(z + 0.5 * kStep) + density(z + kStep)) * (kStep / 6.0);
}

std::unique_ptr<const NormalDeviates> tabulate() {
  auto table = std::make_unique<NormalDeviates>();
  double z = 0.0;
  double below = 0.0;  // the integral from 0 to z
  double share = share_of_step(z);
  double squares = 0.0;
  for (std::size_t i = 0; i < kHalf; ++i) {
    const double wanted = (static_cast<double>(i) + 0.5) / static_cast<double>(2 * kHalf);
    while (below + share < wanted) {
      below += share;
      z += kStep;
      share = share_of_step(z);
    }
    const double quantile = z + kStep * (wanted - below) / share;
    squares += quantile * quantile;
    (*table)[kHalf + i] = static_cast<float>(quantile);
  }
  const auto scale = static_cast<float>(1.0 / std::sqrt(squares / static_cast<double>(kHalf)));
  for (std::size_t i = 0; i < kHalf; ++i) {
    (*table)[kHalf + i] *= scale;
    (*table)[kHalf - 1 - i] = -(*table)[kHalf + i];
  }
  return table;
}

}  // namespace

const NormalDeviates& normal_deviates() {
  static const std::unique_ptr<const NormalDeviates> table = tabulate();
  return *table;
}

}  // namespace dottrack::host_sim
