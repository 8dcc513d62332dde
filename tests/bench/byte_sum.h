#pragma once
// The yardstick: the time to look at every byte once.

#include <cstdint>

#include "hal/base/image_view.h"

namespace dottrack::bench {

// The sum of all pixels, with the widest SIMD of the processor.
std::uint64_t byte_sum(const ImageView& image);

}  // namespace dottrack::bench
