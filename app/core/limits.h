#pragma once
// The capacities that the tracker core is built for. They bound its memory and its work.

#include <cstddef>

#include "hal/base/camera_set.h"

namespace dottrack::core {

inline constexpr std::size_t kMaxDots = 16;
inline constexpr std::size_t kMinDots = 3;
inline constexpr std::size_t kMinPartialDots = 4;   // of a larger target; kMinDots as a last resort
inline constexpr std::size_t kMaxRegions = 1024;    // accepted regions a camera
inline constexpr std::size_t kMaxFinalists = 8192;  // 3-D dot finalists
inline constexpr std::size_t kMaxModelErrors = 12;  // independent ways to be wrong, a camera
inline constexpr int kMaxImageWidth = 2048;
inline constexpr int kMaxImageHeight = 2048;

}  // namespace dottrack::core
