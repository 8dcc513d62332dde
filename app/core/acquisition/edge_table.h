#pragma once
// Which of the target's edges at one dot, its anchor, a distance may be; looked up by the squared
// distance, so that hardly any of an anchor's neighbours costs a square root. What it lets through
// is judged exactly later; what it keeps out fits no edge, whatever the rounding.

#include <array>
#include <cstdint>

#include "app/core/acquisition/target_shape.h"

namespace dottrack::acquisition {

// Dot k of the target is bit k.
using DotSet = std::uint16_t;

class EdgeTable {
 public:
  static constexpr std::size_t kBins = 512;

  // Of the edges from `anchor` to the dots of `ends`, each with the tolerance either way.
  void build(const TargetShape& shape, std::size_t anchor, DotSet ends, double tolerance_m);

  // Beyond it no edge ends.
  float reach_m() const { return reach_m_; }
  float bins_per_m2() const { return bins_per_m2_; }
  // By the square of a distance times bins_per_m2, rounded down and at most kBins.
  const DotSet* dots() const { return dots_.data(); }

 private:
  float reach_m_ = 0.0F;
  float bins_per_m2_ = 0.0F;
  std::array<DotSet, kBins + 1> dots_{};
};

}  // namespace dottrack::acquisition
