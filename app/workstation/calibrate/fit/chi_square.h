#pragma once
// How improbable a sum of squares is.

namespace dottrack::calibrate {

// -log of the probability that the sum of 2 or 3 squared normal numbers is larger.
double surprise2(double sum);
double surprise3(double sum);

// How many standard deviations a normal number, either way, is off that surprises as much.
double as_sigmas(double surprise);

// Medians of the sums.
inline constexpr double kMedian2 = 1.3862943611198906;
inline constexpr double kMedian3 = 2.3659738843753377;

}  // namespace dottrack::calibrate
