#pragma once
// Which surveyed dots lie near each other, and which lies at a place.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "app/workstation/calibrate/views.h"

namespace dottrack::calibrate {

class SurveyIndex {
 public:
  static constexpr std::size_t kNeighbours = 14;

  // layer: as in Scene; a dot's neighbours are of its own layer. Dots of layer -1 have none.
  SurveyIndex(std::span<const SurveyedDot> dots, std::span<const int> layer);

  // The nearest other dots, nearest first.
  const std::vector<int>& neighbours(int dot) const {
    return neighbours_[static_cast<std::size_t>(dot)];
  }
  // Distance to the nearest other dot; 0 for a dot that is alone.
  double spacing_m(int dot) const { return spacing_m_[static_cast<std::size_t>(dot)]; }
  // Median of the dots' spacings.
  double typical_spacing_m() const { return typical_m_; }
  // The nearest dot of the layer within the distance, which is at most half the typical spacing.
  int at(int layer, const Eigen::Vector3d& place_m, double within_m) const;

 private:
  std::int64_t key(const Eigen::Vector3d& place_m, int dx, int dy, int dz) const;

  std::span<const SurveyedDot> dots_;
  std::vector<int> layer_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<double> spacing_m_;
  double typical_m_ = 1.0;
  std::unordered_map<std::int64_t, std::vector<int>> cells_;
};

}  // namespace dottrack::calibrate
