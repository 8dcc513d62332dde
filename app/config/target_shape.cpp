#include "app/config/target_shape.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>

#include "app/config/complaint.h"

namespace dottrack::config {
namespace {

constexpr double kCoincident_m = 1e-6;
// Around the line through all its dots a target can turn unseen. A dot this far off the line, as a
// share of the line's length, is the least that determines the turn to a useful accuracy.
constexpr double kMinOffLine = 0.01;

std::optional<ShapeFault> compare(std::span<const core::TargetDot> dots,
                                  std::span<const std::string> ids, std::size_t i, std::size_t j) {
  const double apart_m = (dots[i].position_m - dots[j].position_m).norm();
  const double needed_m = 0.5 * (dots[i].diameter_m + dots[j].diameter_m);
  if (apart_m <= kCoincident_m) {
    return ShapeFault{
        i, fmt::format("dot {} coincides with dot {}", in_quotes(ids[i]), in_quotes(ids[j])),
        "dots at different places"};
  }
  if (apart_m < needed_m) {
    return ShapeFault{i,
                      fmt::format("dot {} overlaps dot {}: {:.4g} m apart", in_quotes(ids[i]),
                                  in_quotes(ids[j]), apart_m),
                      fmt::format("at least {:.4g} m, half the sum of their diameters", needed_m)};
  }
  return std::nullopt;
}

// The dots of the longest distance span the line that all others are held against.
std::pair<std::size_t, std::size_t> farthest_pair(std::span<const core::TargetDot> dots) {
  std::pair<std::size_t, std::size_t> pair{0, 0};
  double longest_m = -1.0;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double apart_m = (dots[i].position_m - dots[j].position_m).norm();
      if (apart_m <= longest_m) continue;
      longest_m = apart_m;
      pair = {j, i};
    }
  }
  return pair;
}

std::optional<ShapeFault> find_line(std::span<const core::TargetDot> dots) {
  const auto [a, b] = farthest_pair(dots);
  const Eigen::Vector3d along = dots[b].position_m - dots[a].position_m;
  const double length_m = along.norm();
  double off_m = 0.0;
  for (const core::TargetDot& dot : dots) {
    off_m = std::max(off_m, along.cross(dot.position_m - dots[a].position_m).norm() / length_m);
  }
  if (off_m >= kMinOffLine * length_m) return std::nullopt;
  return ShapeFault{dots.size() - 1, "all dots lie on a line",
                    fmt::format("a dot at least {:.4g} m off it, {:g} % of its length",
                                kMinOffLine * length_m, 100.0 * kMinOffLine)};
}

}  // namespace

std::optional<ShapeFault> find_shape_fault(std::span<const core::TargetDot> dots,
                                           std::span<const std::string> ids) {
  for (std::size_t i = 0; i < dots.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (auto fault = compare(dots, ids, i, j)) return fault;
    }
  }
  return find_line(dots);
}

}  // namespace dottrack::config
