#pragma once
// Sums over the pixels of a component: all that its moments are made of.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/core/image/components.h"
#include "app/core/image/local_background.h"
#include "app/core/image/run_scan.h"
#include "app/core/rig.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// x and y count from the corner of the component's bounding box. All integers, and exact.
struct RegionSums {
  enum Sum : std::size_t { kX, kXx, kY, kXy, kYy, kV, kVx, kVy };  // v: a pixel's value

  std::array<double, 8> of = {};
  double saturated_px = 0.0;  // pixels at 255
  int faintest_dn = 0;        // pixel; bright: darkest; dark: brightest
  bool has_values = false;    // if not: v, vx, vy and the two above are anything
  int n = 0;
  int width = 0;  // of the bounding box
  int height = 0;

  // From a corner to one that is so much further right and down.
  void move_corner(int dx, int dy);
};

// What the sums are of: `pixels` is the image inside the searched window. Its values are the pixels
// themselves or, where there are thresholds, by how much they go beyond theirs.
struct SumsOf {
  const ImageView& pixels;
  const Thresholds& thresholds;
  core::Polarity polarity;
  const RunList& runs;
  const Components& components;
};

// What may be a dot.
struct Candidate {
  Component component;
  // Of a small component, whose box these are: see SmallComponent. It has no runs. 0: all others.
  std::uint64_t box_bits;
};

// The sums of candidates[i] to sums[i]: of large ones without the values, which cost as much as
// they have pixels, and few turn out to be dots.
void sum_regions(const SumsOf& of, std::span<const Candidate> candidates, RegionSums* sums);

// Adds the values.
void sum_values(const SumsOf& of, const Component& component, RegionSums& sums);

}  // namespace dottrack::image
