#include "app/workstation/calibrate/labelling/survey_index.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dottrack::calibrate {

SurveyIndex::SurveyIndex(std::span<const SurveyedDot> dots, std::span<const int> layer)
    : dots_(dots), layer_(layer.begin(), layer.end()), neighbours_(dots.size()) {
  std::vector<double> known;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    std::vector<std::pair<double, int>> others;
    for (std::size_t j = 0; j < dots.size() && layer_[i] >= 0; ++j) {
      if (j == i || layer_[j] != layer_[i]) continue;
      others.emplace_back((dots[j].position_m - dots[i].position_m).squaredNorm(),
                          static_cast<int>(j));
    }
    const std::size_t kept = std::min(kNeighbours, others.size());
    std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(kept),
                      others.end());
    for (std::size_t n = 0; n < kept; ++n) neighbours_[i].push_back(others[n].second);
    spacing_m_.push_back(kept > 0 ? std::sqrt(others.front().first) : 0.0);
    if (kept > 0) known.push_back(spacing_m_.back());
  }
  if (!known.empty()) {
    const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
    std::nth_element(known.begin(), middle, known.end());
    if (*middle > 0.0) typical_m_ = *middle;
  }
  for (std::size_t i = 0; i < dots.size(); ++i) {
    cells_[key(dots[i].position_m, 0, 0, 0)].push_back(static_cast<int>(i));
  }
}

std::int64_t SurveyIndex::key(const Eigen::Vector3d& place_m, int dx, int dy, int dz) const {
  const auto cell = [&](double v, int d) {
    return static_cast<std::int64_t>(std::floor(2.0 * v / typical_m_)) + d;
  };
  return (cell(place_m.x(), dx) * 73856093) ^ (cell(place_m.y(), dy) * 19349663) ^
         (cell(place_m.z(), dz) * 83492791);
}

int SurveyIndex::at(int layer, const Eigen::Vector3d& place_m, double within_m) const {
  int best = -1;
  double least = within_m * within_m;
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dz = -1; dz <= 1; ++dz) {
        const auto cell = cells_.find(key(place_m, dx, dy, dz));
        if (cell == cells_.end()) continue;
        for (const int dot : cell->second) {
          const auto i = static_cast<std::size_t>(dot);
          const double squared = (dots_[i].position_m - place_m).squaredNorm();
          if (layer_[i] != layer || !(squared <= least)) continue;
          least = squared;
          best = dot;
        }
      }
    }
  }
  return best;
}

}  // namespace dottrack::calibrate
