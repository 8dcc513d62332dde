#include "tests/board/harness/exposure_matching.h"

#include <algorithm>

namespace dottrack::board {

std::optional<ExposureMatch> match_exposure(Time stamp, std::span<const host_sim::Barrier> barriers,
                                            Duration exposure, Duration reach) {
  const auto distance = [&](const host_sim::Barrier& barrier) {
    const Duration late = stamp - (barrier.released - exposure / 2);
    return late < Duration::zero() ? -late : late;
  };
  const auto nearest =
      std::min_element(barriers.begin(), barriers.end(),
                       [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  if (nearest == barriers.end() || distance(*nearest) >= reach) return std::nullopt;
  return ExposureMatch{*nearest, stamp - (nearest->released - exposure / 2)};
}

}  // namespace dottrack::board
