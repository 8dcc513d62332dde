#include "app/core/acquisition/target_shape.h"

#include <limits>

namespace dottrack::acquisition {
namespace {

double sum_of_squared_edges(const TargetShape& shape, std::size_t dot) {
  double sum = 0.0;
  for (std::size_t k = 0; k < shape.dots; ++k) {
    sum += shape.distance_m[dot][k] * shape.distance_m[dot][k];
  }
  return sum;
}

}  // namespace

TargetShape make_target_shape(const core::Target& target) {
  TargetShape shape;
  shape.dots = target.dots.size();
  shape.upright = target.upright;
  for (std::size_t i = 0; i < shape.dots; ++i) {
    shape.position_m[i] = target.dots[i].position_m;
    shape.diameter_m[i] = target.dots[i].diameter_m;
    for (std::size_t j = 0; j < shape.dots; ++j) {
      shape.distance_m[i][j] = (target.dots[i].position_m - target.dots[j].position_m).norm();
    }
  }
  const auto n = static_cast<double>(shape.dots);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < shape.dots; ++i) {
    const double sum = sum_of_squared_edges(shape, i);
    shape.variance_m2 += sum / (2.0 * n * n);
    if (sum >= nearest) continue;
    nearest = sum;
    shape.anchor = i;
  }
  return shape;
}

}  // namespace dottrack::acquisition
