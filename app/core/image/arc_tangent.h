#pragma once
// The angles of vectors to 2e-8 rad: faster than the C library's and, unlike that, the same bits on
// every machine.

#include <span>

namespace dottrack::image {

// angle[i] as std::atan2(y[i], x[i]), but 0 for the zero vector whatever its signs and pi, not -pi,
// for (-0, -x). All three are equally long.
void arc_tangents(std::span<const double> y, std::span<const double> x, std::span<double> angle);

}  // namespace dottrack::image
