#pragma once
// Which measured components are dot candidates, and what they look like (paper section 3.3).

#include <cstdint>
#include <span>

#include "app/core/image/components.h"
#include "app/core/image/identify.h"
#include "app/core/image/moments.h"
#include "app/core/image/region_sums.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// Candidates in a window of the image, with their sums and moments.
struct Candidates {
  const ImageView& image;
  const Window& window;
  const SumsOf& of;
  const PixelWeights& weights;
  std::span<const Candidate> all;
  std::span<RegionSums> sums;
  const Moments& moments;
};

// Appends those that pass the gate to the regions, and counts where each went. Values that were
// left out are summed where the outline may be a dot's.
void judge(const Candidates& candidates, const RegionGate& gate, Regions& regions,
           IdentifyCounts& counts);

}  // namespace dottrack::image
