#include "app/core/acquisition/chance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dottrack::acquisition {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

// Rivals are counted within this many target diameters of the chosen dots' mean.
constexpr double kNeighbourhood = 2.0;

Vector3d mean_position(const TargetShape& shape, std::span<const Finalist> finalists,
                       const Selection& selection) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < shape.dots; ++i) sum += finalists[selection.assignment[i]].position_m;
  return sum / static_cast<double>(shape.dots);
}

double longest_edge(const TargetShape& shape) {
  double longest = 0.0;
  for (std::size_t i = 0; i < shape.dots; ++i) {
    longest = std::max(longest,
                       *std::max_element(shape.distance_m[i].begin(), shape.distance_m[i].end()));
  }
  return longest;
}

class Rivals {
 public:
  Rivals(std::span<const Finalist> finalists, const Vector3d& middle_m, double radius_m)
      : volume_m3_(4.0 / 3.0 * kPi * radius_m * radius_m * radius_m) {
    for (const Finalist& f : finalists) {
      const auto views = static_cast<std::size_t>(f.cameras.size());
      all_[views] += 1.0;
      if ((f.position_m - middle_m).norm() <= radius_m) near_[views] += 1.0;
    }
    // Counts of those with at least so many views.
    for (std::size_t v = kMaxCameras; v-- > 0;) {
      all_[v] += all_[v + 1];
      near_[v] += near_[v + 1];
    }
  }

  double count(const Finalist& chosen) const {
    return all_[static_cast<std::size_t>(chosen.cameras.size())];
  }
  double per_m3(const Finalist& chosen) const {
    return near_[static_cast<std::size_t>(chosen.cameras.size())] / volume_m3_;
  }

 private:
  std::array<double, kMaxCameras + 1> all_{};
  std::array<double, kMaxCameras + 1> near_{};
  double volume_m3_;
};

// Distance of the third dot from the line through the first two.
double height_over_first_edge(const TargetShape& shape) {
  const Vector3d edge = (shape.position_m[1] - shape.position_m[0]).normalized();
  const Vector3d to = shape.position_m[2] - shape.position_m[0];
  return (to - to.dot(edge) * edge).norm();
}

}  // namespace

double fit_of(const TargetShape& shape, std::span<const Finalist> finalists,
              const Selection& selection) {
  double edges2 = 0.0;
  double sigma2 = 0.0;
  const auto n = static_cast<double>(shape.dots);
  for (std::size_t i = 0; i < shape.dots; ++i) {
    const Finalist& a = finalists[selection.assignment[i]];
    sigma2 += a.covariance_m2.trace() / 3.0 / n;
    for (std::size_t j = i + 1; j < shape.dots; ++j) {
      const Vector3d edge = finalists[selection.assignment[j]].position_m - a.position_m;
      const double off = edge.norm() - shape.distance_m[i][j];
      edges2 += off * off / (0.5 * n * (n - 1.0));
    }
  }
  return std::sqrt(edges2 + sigma2);
}

double chance_matches(const TargetShape& shape, std::span<const Finalist> finalists,
                      const Selection& selection) {
  const Rivals rivals(finalists, mean_position(shape, finalists, selection),
                      kNeighbourhood * longest_edge(shape));
  // Twice the fit to each side.
  const double width_m = 4.0 * fit_of(shape, finalists, selection);
  const auto chosen = [&](std::size_t dot) -> const Finalist& {
    return finalists[selection.assignment[dot]];
  };
  const double first_edge_m = shape.distance_m[0][1];
  const double shell_m3 = 4.0 * kPi * first_edge_m * first_edge_m * width_m;
  const double ring_m3 = 2.0 * kPi * height_over_first_edge(shape) * width_m * width_m;
  const double balls_m3 = 2.0 * width_m * width_m * width_m;
  double expected = rivals.count(chosen(0)) * rivals.per_m3(chosen(1)) * shell_m3 *
                    rivals.per_m3(chosen(2)) * ring_m3;
  for (std::size_t dot = 3; dot < shape.dots; ++dot)
    expected *= rivals.per_m3(chosen(dot)) * balls_m3;
  return expected;
}

}  // namespace dottrack::acquisition
