#include "app/core/rig.h"

#include <algorithm>

namespace dottrack::core {
namespace {

bool smaller(const TargetDot& a, const TargetDot& b) {
  return a.diameter_m < b.diameter_m;
}

}  // namespace

double largest_dot_diameter_m(const Target& target) {
  const auto it = std::max_element(target.dots.begin(), target.dots.end(), smaller);
  return it == target.dots.end() ? 0.0 : it->diameter_m;
}

double smallest_dot_diameter_m(const Target& target) {
  const auto it = std::min_element(target.dots.begin(), target.dots.end(), smaller);
  return it == target.dots.end() ? 0.0 : it->diameter_m;
}

}  // namespace dottrack::core
