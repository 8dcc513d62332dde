#pragma once
// What is wrong with a dot as a camera shows it.

#include <cstdint>
#include <string_view>

namespace dottrack::core {

enum class DotFlaw : std::uint8_t {
  none = 0,
  border = 1,      // the image ends in it
  saturated = 2,   // overexposed, and what spilt out of its pixels has changed its shape
  hidden = 3,      // something covers or shades a part of it
  merged = 4,      // something of its own brightness lies against it
  faint = 5,       // hardly brighter than noise
  not_fitted = 6,  // too large, too small, or nothing that an ellipse describes
};

// One word each: "hidden".
std::string_view to_string(DotFlaw flaw);

}  // namespace dottrack::core
