#pragma once
// A number that tells two pictures apart.

#include <cstdint>

#include "hal/base/image_view.h"

namespace dottrack::core {

// Of every 16th row: noise shows in each. The same on every processor.
std::uint64_t fingerprint(const ImageView& image);

}  // namespace dottrack::core
