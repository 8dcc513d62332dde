#include "app/core/acquisition/edge_table.h"

#include <algorithm>

namespace dottrack::acquisition {

void EdgeTable::build(const TargetShape& shape, std::size_t anchor, DotSet ends,
                      double tolerance_m) {
  double longest_m = 0.0;
  for (std::size_t k = 0; k < shape.dots; ++k) {
    if ((ends >> k & 1U) != 0) longest_m = std::max(longest_m, shape.distance_m[anchor][k]);
  }
  const double reach_m = longest_m + tolerance_m;
  reach_m_ = static_cast<float>(reach_m);
  // The last bin but one is left to rounding, the last one to whatever is out of reach.
  const double scale = static_cast<double>(kBins - 2) / (reach_m * reach_m);
  bins_per_m2_ = static_cast<float>(scale);
  dots_.fill(0);
  for (std::size_t k = 0; k < shape.dots; ++k) {
    if ((ends >> k & 1U) == 0) continue;
    const double edge_m = shape.distance_m[anchor][k];
    const double least_m = std::max(0.0, edge_m - tolerance_m);
    const double most_m = edge_m + tolerance_m;
    const auto first = static_cast<std::size_t>(std::max(0.0, least_m * least_m * scale - 1.0));
    const auto last = static_cast<std::size_t>(most_m * most_m * scale + 1.0);
    for (std::size_t bin = first; bin <= std::min(last, kBins - 1); ++bin) {
      dots_[bin] |= static_cast<DotSet>(1U << k);
    }
  }
}

}  // namespace dottrack::acquisition
