#include "app/core/acquisition/edge_table.h"

#include <algorithm>
#include <cmath>

namespace dottrack::acquisition {
namespace {

// A float's rounding of a squared distance is less than half of it.
constexpr double kRounding = 1e-6;

double squared(double v) {
  return v * v;
}

// What is within the tolerance of one edge, or of several that overlap.
struct Interval {
  double least_m2 = 0.0;
  double most_m2 = 0.0;
  DotSet dots = 0;
};
using Intervals = StaticVector<Interval, core::kMaxDots>;

// By their beginnings.
Intervals intervals_of(const TargetShape& shape, std::size_t anchor, DotSet ends,
                       double tolerance_m) {
  const auto later = [](const Interval& a, const Interval& b) { return a.least_m2 < b.least_m2; };
  Intervals intervals;
  for (std::size_t k = 0; k < shape.dots; ++k) {
    if (!holds(ends, k)) continue;
    const double edge_m = shape.distance_m[anchor][k];
    const Interval interval{squared(std::max(0.0, edge_m - tolerance_m)),
                            squared(edge_m + tolerance_m), dot_bit(k)};
    intervals.insert(std::upper_bound(intervals.begin(), intervals.end(), interval, later),
                     interval);
  }
  return intervals;
}

EdgeTable::Window window_of(const Interval& interval) {
  return {static_cast<float>(0.5 * (interval.least_m2 + interval.most_m2)),
          static_cast<float>(0.5 * (interval.most_m2 - interval.least_m2) +
                             kRounding * interval.most_m2)};
}

}  // namespace

void EdgeTable::build(const TargetShape& shape, std::size_t anchor, DotSet ends,
                      double tolerance_m) {
  dots_.fill(0);
  windows_.clear();
  Interval joint{.most_m2 = -1.0};
  const Intervals intervals = intervals_of(shape, anchor, ends, tolerance_m);
  double most_m2 = 0.0;
  for (const Interval& interval : intervals) most_m2 = std::max(most_m2, interval.most_m2);
  reach_m_ = static_cast<float>(std::sqrt(most_m2));
  // The last bin is left to rounding.
  const double bins_per_m2 = static_cast<double>(kBins - 2) / most_m2;
  bins_per_m2_ = static_cast<float>(bins_per_m2);
  for (const Interval& interval : intervals) {
    mark_bins(interval.least_m2 * bins_per_m2, interval.most_m2 * bins_per_m2, interval.dots);
    if (interval.least_m2 <= joint.most_m2) {
      joint.most_m2 = std::max(joint.most_m2, interval.most_m2);
      windows_.back() = window_of(joint);
    } else {
      joint = interval;
      windows_.push_back(window_of(joint));
    }
  }
}

// And one bin more either way, for rounding.
void EdgeTable::mark_bins(double first, double last, DotSet dots) {
  const auto end = std::min(static_cast<std::size_t>(last) + 2, kBins);
  for (auto bin = static_cast<std::size_t>(std::max(0.0, first - 1.0)); bin < end; ++bin) {
    dots_[bin] |= dots;
  }
}

}  // namespace dottrack::acquisition
