#pragma once
// Which pixels lie in the intensity band (paper section 3.1.2), 64 at a time.

#include "app/core/image/bitmap.h"
#include "app/core/image/identify.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// bitmap(x, y) = image(window.x_min + x, window.y_min + y) in [intensity_min_dn, intensity_max_dn].
// The window lies inside the image and the image inside the bitmap's capacity. No byte beyond
// the end of a row is read.
void fill_band_bitmap(const ImageView& image, const Window& window, const Band& band,
                      Bitmap& bitmap);

}  // namespace dottrack::image
