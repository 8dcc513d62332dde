#include "app/workstation/calibrate/fit/foretelling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dottrack::calibrate {

Comparison compare(const Foretelling& a, const Foretelling& b) {
  const auto n = static_cast<double>(a.sigmas2.size());
  double sum = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < a.sigmas2.size(); ++i) {
    const double difference =
        std::min(a.sigmas2[i], kCutSigmas2) - std::min(b.sigmas2[i], kCutSigmas2);
    sum += difference;
    square += difference * difference;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(square / n - mean * mean, 0.0) / n)};
}

double rms_px(const Foretelling& f, double unit) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < f.sigmas2.size(); ++i) {
    if (f.sigmas2[i] > kCutSigmas2 * unit) continue;
    sum += f.off2_px[i];
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : std::numeric_limits<double>::infinity();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace dottrack::calibrate
