#include "app/core/acquisition/target_shape.h"

#include <limits>
#include <utility>

namespace dottrack::acquisition {
namespace {

// Over the edges from this dot to those that are no anchors yet.
double sum_of_squared_edges(const TargetShape& shape, std::size_t anchors, std::size_t dot) {
  double sum = 0.0;
  for (std::size_t k = anchors; k < shape.dots; ++k) {
    const double edge = shape.distance_m[dot][shape.anchors[k]];
    sum += edge * edge;
  }
  return sum;
}

void order_anchors(TargetShape& shape) {
  for (std::size_t i = 0; i < shape.dots; ++i) shape.anchors[i] = static_cast<std::uint8_t>(i);
  for (std::size_t i = 0; i < shape.dots; ++i) {
    std::size_t next = i;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = i; k < shape.dots; ++k) {
      const double sum = sum_of_squared_edges(shape, i, shape.anchors[k]);
      if (sum >= nearest) continue;
      nearest = sum;
      next = k;
    }
    std::swap(shape.anchors[i], shape.anchors[next]);
  }
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
  order_anchors(shape);
  return shape;
}

}  // namespace dottrack::acquisition
