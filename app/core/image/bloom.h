#pragma once
// Blooming told from mere brightness (paper section 5: an asymmetrical enlargement of the dots).

#include "app/core/image/region.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// How far an unbloomed dot would reach from its centre, pixels.
struct DotExtent {
  double half_width_px = 0.0;
  double half_height_px = 0.0;
};

// Of the ellipse with these axes, the major one `angle_rad` from +x towards +y.
DotExtent extent_of(double semi_major_px, double semi_minor_px, double angle_rad);

struct BloomEvidence {
  int saturated_px = 0;  // of the region
  // How much further the region reaches along its columns, the direction of read-out, than the dot
  // would, less what it reaches further along its rows: brightness blurs a dot all round, blooming
  // spills along the columns alone. Half the height, pixels.
  double growth_px = 0.0;
  // How much lower the middles of the saturated columns lie where the dot is widest than at its
  // sides: a long column spills more, and most of it one way. 0 for an ellipse, however it lies.
  double sag_px = 0.0;

  bool bloomed() const;
};

// `region` as identify found it in `image`; `expected` may be the largest that the dot can look.
BloomEvidence bloom_evidence(const ImageView& image, const Region& region,
                             const DotExtent& expected);

}  // namespace dottrack::image
