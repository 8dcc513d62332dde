#pragma once
// What numbers a rig may hold. Whatever writes rig files keeps to the same rules.

#include "app/config/table_reader.h"

namespace dottrack::config {

inline constexpr NumberRule kDistance{0.0, 1000.0,
                                      "two numbers of metres, 0 < nearest < farthest <= 1000"};
inline constexpr NumberRule kStep{0.0, 100.0, "a number of metres above 0 and up to 100"};
inline constexpr NumberRule kDotSigma{0.0, 0.1, "a number of metres from 0 to 0.1", true};
inline constexpr IntegerRule kIntensity{0, 255,
                                        "two whole numbers, 0 <= darkest <= brightest <= 255"};
inline constexpr IntegerRule kContrast{0, 254, "a whole number from 0 to 254"};
inline constexpr NumberRule kContrastPart{0.0, 4.0, "a number from 0 to 4", true};
inline constexpr IntegerRule kBackground{3, 255, "an odd whole number from 3 to 255"};

}  // namespace dottrack::config
