#pragma once
// Which pixels lie in the intensity band (paper section 3.1.2), 64 at a time.

#include "app/core/image/bitmap.h"
#include "app/core/image/identify.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// bitmap(x, y) = image(window.x_min + x, window.y_min + y) in [intensity_min_dn, intensity_max_dn]
// for the rows y_first <= y < y_end of the bitmap, which is as large as the window. The window lies
// inside the image. No byte beyond the end of a row is read.
void fill_band_rows(const ImageView& image, const Window& window, const Band& band, int y_first,
                    int y_end, Bitmap& bitmap);

}  // namespace dottrack::image
