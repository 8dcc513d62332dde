#pragma once
// Which of the target's edges at one dot, its anchor, a distance may be; told by the squared
// distance, so that hardly any of an anchor's neighbours costs a square root. What it lets through
// is judged exactly later; what it keeps out fits no edge, whatever the rounding.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "app/core/acquisition/target_shape.h"
#include "hal/base/static_vector.h"

namespace dottrack::acquisition {

// Dot k of the target is bit k.
using DotSet = std::uint16_t;

constexpr DotSet dot_bit(std::size_t dot) {
  return static_cast<DotSet>(1U << dot);
}
constexpr bool holds(DotSet dots, std::size_t dot) {
  return (dots & dot_bit(dot)) != 0;
}

class EdgeTable {
 public:
  static constexpr std::size_t kBins = 512;

  // Squared distances that fit some edge lie this near to this one.
  struct Window {
    float middle_m2 = 0.0F;
    float reach_m2 = 0.0F;
  };

  // Of the edges from `anchor` to the dots of `ends`, each with the tolerance either way.
  void build(const TargetShape& shape, std::size_t anchor, DotSet ends, double tolerance_m);

  // Beyond it no edge ends.
  float reach_m() const { return reach_m_; }
  // They do not overlap.
  std::span<const Window> windows() const { return {windows_.data(), windows_.size()}; }
  // The dots whose edges a squared distance in one of the windows may be.
  DotSet dots(float distance_m2) const {
    return dots_[static_cast<std::size_t>(std::min(distance_m2 * bins_per_m2_, kLastBin))];
  }

 private:
  static constexpr float kLastBin = kBins - 1;

  void mark_bins(double first, double last, DotSet dots);

  float reach_m_ = 0.0F;
  float bins_per_m2_ = 0.0F;
  StaticVector<Window, core::kMaxDots> windows_;
  std::array<DotSet, kBins> dots_{};
};

}  // namespace dottrack::acquisition
