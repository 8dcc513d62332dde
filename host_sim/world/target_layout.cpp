#include "host_sim/world/target_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host_sim/world/outline.h"
#include "host_sim/world/random.h"
#include "host_sim/world/rover.h"

namespace dottrack::host_sim {
namespace {

constexpr double kDiameter_m = 0.10;
constexpr double kBetweenDots_m = 0.19;  // centre to centre
constexpr double kToEdge_m = 0.085;
constexpr double kDistinct_m = 0.03;

TargetDot on_deck(const Eigen::Vector2d& p) {
  return {{p.x(), p.y(), kDeckHeight_m}, kDiameter_m, Eigen::Vector3d::UnitZ()};
}

std::vector<double> sorted_distances(const TargetLayout& layout, std::size_t from) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    if (i != from) distances.push_back((layout[i].centre_m - layout[from].centre_m).norm());
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

bool has_room_on_deck(const Eigen::Vector2d& p) {
  if (!inside(deck_outline(), p) || distance_to_edge(deck_outline(), p) < kToEdge_m) return false;
  const auto clear = [&](const Keepout& k) { return (p - k.middle).norm() >= k.radius_m; };
  return std::all_of(deck_keepouts().begin(), deck_keepouts().end(), clear);
}

// One throw of n dots; fewer than n when there was no room for them all.
TargetLayout throw_dots(int dots, RandomStream& random) {
  TargetLayout layout;
  for (int attempt = 0; attempt < 4000 && static_cast<int>(layout.size()) < dots; ++attempt) {
    const Eigen::Vector2d p{random.uniform(-0.74, 0.66), random.uniform(-0.86, 0.86)};
    const auto apart = [&](const TargetDot& dot) {
      return (dot.centre_m.head<2>() - p).norm() >= kBetweenDots_m;
    };
    if (has_room_on_deck(p) && std::all_of(layout.begin(), layout.end(), apart)) {
      layout.push_back(on_deck(p));
    }
  }
  return layout;
}

}  // namespace

double distinctness_m(const TargetLayout& layout) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const std::vector<double> a = sorted_distances(layout, i);
    for (std::size_t j = i + 1; j < layout.size(); ++j) {
      const std::vector<double> b = sorted_distances(layout, j);
      double worst = 0.0;
      for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, std::abs(a[k] - b[k]));
      least = std::min(least, worst);
    }
  }
  return least;
}

TargetLayout demo_layout() {
  return {on_deck({0.20, 0.68}), on_deck({-0.08, -0.66}), on_deck({-0.64, 0.02}),
          on_deck({0.30, -0.30}), on_deck({-0.26, 0.30})};
}

TargetLayout random_layout(int dots, std::uint64_t seed) {
  RandomStream random(seed, 0x1A7);
  TargetLayout best;
  double best_distinctness_m = -1.0;
  for (int attempt = 0; attempt < 200; ++attempt) {
    const TargetLayout layout = throw_dots(dots, random);
    if (static_cast<int>(layout.size()) != dots) continue;
    if (distinctness_m(layout) > best_distinctness_m) {
      best = layout;
      best_distinctness_m = distinctness_m(layout);
    }
    if (best_distinctness_m >= kDistinct_m) break;
  }
  return best;
}

}  // namespace dottrack::host_sim
