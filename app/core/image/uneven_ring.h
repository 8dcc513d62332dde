#pragma once
// Dots that lie on something small, a plate of their own, say: the ring reaches beyond its edge.

#include "app/core/image/dot_patch.h"
#include "app/core/image/outline_sums.h"
#include "app/core/image/ring_sums.h"

namespace dottrack::image {

// How far off a plane noise alone takes a pixel.
inline constexpr double kOutlierSigmas = 3.5;
inline double noise_limit_dn(const Plane& plane) {
  return kOutlierSigmas * plane.sigma + 1.0;
}

// The plane through what is like most of what is nearest (find_level): the dot lies on that.
// `nearest`: that part, between its inner and outer spans. `mask` and `whole` are the ring's
// (sum_patch). The plane stays as it is where there are too few pixels.
void find_own_ground(const ImageView& patch, const PatchRows& nearest, const RingMask& mask,
                     const GreySums& whole, Plane& plane);

// How far a dot goes: where its light reaches, and where its edge is; how much of its light may be
// outside, negative of a dark dot's.
struct DotReach {
  const Spans& lit;
  const Spans& edge;
  double tail_dn;
};

// Takes out of dot and ring what is off the plane where the dot's light does not reach, and the
// pixels next to that, into which it is blurred, up to the dot's edge. `sums` are of all of it.
void drop_strangers(const ImageView& patch, const PatchRows& rows, const DotReach& reach,
                    const Plane& plane, PatchSums& sums, DotPixels& pixels);

}  // namespace dottrack::image
