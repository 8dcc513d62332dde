#pragma once
// What a region's size and centroid are worth.

namespace dottrack::estimation {

// Bounds on measured over true size, with what a threshold may add or take at the rim.
// On the real plate images a dot's axes come out 1.2 to 1.45 times their nominal length.
inline constexpr double kShrink = 0.75;
inline constexpr double kGrow = 1.5;
inline constexpr double kGrowRim_px = 1.0;

// Standard deviation that a grey-weighted centroid is trusted to, pixels; the pose's covariance
// is scaled up by what the residuals show beyond it.
inline constexpr double kCentroidSigma_px = 0.1;

}  // namespace dottrack::estimation
