#pragma once
// Cache lines of an image that are sent for while something else is worked on.

#include <hwy/cache_control.h>

#include <algorithm>
#include <cstdint>

#include "hal/base/image_view.h"

namespace dottrack::image {

class LinesAhead {
 public:
  static constexpr std::ptrdiff_t kLine_bytes = 64;

  // Those of the rows y_first <= y < y_end. One line more may be sent for.
  LinesAhead(const ImageView& image, int y_first, int y_end)
      : next_(image.row(std::min(y_first, image.height_px - 1))),
        end_(std::max(next_, image.row(std::clamp(y_end, y_first, image.height_px) - 1))) {}

  // Sends for one; when there are no more, for the last again.
  void send() {
    hwy::Prefetch(next_);
    next_ = std::min(next_ + kLine_bytes, end_);
  }

 private:
  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

}  // namespace dottrack::image
