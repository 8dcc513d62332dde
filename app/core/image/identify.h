#pragma once
// Identify: from one image, or a window of it, to its dot candidates (paper section 3.1.2).

#include <cstddef>
#include <cstdint>
#include <memory>

#include "app/core/image/region.h"
#include "app/core/limits.h"
#include "app/core/rig.h"
#include "hal/base/image_view.h"
#include "hal/base/static_vector.h"

namespace dottrack::image {

// Which pixels may belong to a dot.
struct Band {
  int intensity_min_dn = 0;
  int intensity_max_dn = 255;
  int min_contrast_dn = 0;  // 0: the absolute band alone
  int background_px = 21;   // odd, 3 to 255; rounded to tiles: see LocalBackground
  core::Polarity polarity = core::Polarity::bright;
  // Of the background, where that is more than min_contrast_dn; only beside one above 0.
  int min_contrast_256ths = 0;
};

// Which regions may be dots, from their size and shape in the image.
struct RegionGate {
  double semi_major_min_px = 0.0;
  double semi_major_max_px = 1e9;
  double min_axis_ratio = 0.0;           // semi-minor over semi-major
  double min_fill = 0.0;                 // area over the area of the ellipse with the same moments
  double min_core_contrast_dn = -256.0;  // of Region::core_contrast_dn
  // Region::box_misfit_px may be this much and this part of the semi-major axis (paper section 3.3:
  // a check of the symmetry of the shape, early).
  double max_box_misfit_px = 1e9;
  double max_box_misfit_part = 0.0;
  // What fill lacks of 1, times the semi-minor axis: a ragged rim costs an ellipse of any size
  // about as much, another shape the more the larger it is.
  double max_lack_px = 1e9;
  int min_area_px = 2;  // a single pixel is never a dot
};

struct Window {  // both ends included; clipped to the image
  int x_min = 0;
  int y_min = 0;
  int x_max = 0;
  int y_max = 0;
};

using Regions = StaticVector<Region, core::kMaxRegions>;

// Where the candidates of one image went.
struct IdentifyCounts {
  std::uint32_t runs = 0;        // horizontal runs of in-band pixels
  std::uint32_t components = 0;  // connected regions of at least two pixels
  std::uint32_t rejected_size = 0;
  std::uint32_t rejected_shape = 0;
  std::uint32_t accepted = 0;
  std::uint32_t overflow_runs = 0;  // runs beyond capacity: the rest of the image was not searched
  std::uint32_t overflow_regions = 0;  // accepted regions beyond capacity: left out
};

// The scratch memory of identify: one object serves any number of images, one after another.
// All of it is taken at construction. The results do not depend on the processor's SIMD
// instructions: every decision on a pixel is integer arithmetic, with backgrounds that are rounded
// alike everywhere.
class Identifier {
 public:
  Identifier();
  ~Identifier();
  Identifier(const Identifier&) = delete;
  Identifier& operator=(const Identifier&) = delete;

  // Whole image. Regions come in order of their first pixel, row by row.
  // An image that is empty or larger than kMaxImageWidth x kMaxImageHeight gives no regions.
  IdentifyCounts identify(const ImageView& image, const Band& band, const RegionGate& gate,
                          Regions& regions);
  // The same inside a window only; the local background still sees the whole image.
  IdentifyCounts identify(const ImageView& image, const Window& window, const Band& band,
                          const RegionGate& gate, Regions& regions);

  std::size_t footprint_bytes() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace dottrack::image
