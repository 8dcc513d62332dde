#pragma once
// How well views that a model was not fitted to are foretold, and whether one model does it better.

#include <vector>

namespace dottrack::calibrate {

// A view that is further off counts as this far.
inline constexpr double kCutSigmas2 = 16.0;

// What a kind foretells of one camera's views, in their order.
struct Foretelling {
  std::vector<double> sigmas2;
  std::vector<double> off2_px;
};

// How much worse, on average over the views, and how sure that is.
struct Comparison {
  double mean = 0.0;
  double error = 0.0;
};

// Of a over b, the same views of both in the same order.
Comparison compare(const Foretelling& a, const Foretelling& b);

// Root mean square distance of the views that are not cut, `unit` being the scale of squared
// sigmas.
double rms_px(const Foretelling& foretelling, double unit);

double median(std::vector<double> values);  // of at least one

}  // namespace dottrack::calibrate
