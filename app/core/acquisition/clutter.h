#pragma once
// How many finalists there are by chance: where, seen by how many cameras, how large.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "app/core/acquisition/finalists.h"
#include "app/core/rig.h"
#include "hal/base/static_vector.h"

namespace dottrack::acquisition {

struct Witness;

// All finalists but the candidate's own and their splinters: those that share one of its sightings
// or lie within a dot of its own. Refers to the finalists; memory is its own.
class Clutter {
 public:
  Clutter(const core::Target& target, std::span<const Witness> witnesses,
          std::span<const Finalist> finalists);

  // The box that holds all finalists, a room at the least.
  double room_m3() const;

  // Finalists with at least so many views per cubic metre, at this place. From the nearest ones in
  // a cube around it; where they lie in a level plane, a floor or a table, from those in a thin
  // layer. Where there are hardly any, of the whole room, and never nothing.
  double density_per_m3(const Eigen::Vector3d& position_m, int views) const;

  // Natural logarithm of the density of diameters, per unit of the diameter's logarithm.
  double log_size_density(double diameter_m) const;

 private:
  static constexpr std::size_t kSizeBins = 32;

  void set_room();
  void count_sizes();
  double box_m3(const Eigen::Vector3d& at, double half_width_m, double half_height_m) const;
  double nearest_per_m3(const Eigen::Vector3d& at, int views, double layer_m) const;
  double size_bin(double diameter_m) const;

  std::span<const Finalist> finalists_;
  StaticVector<std::uint16_t, core::kMaxFinalists> clutter_;  // indices of finalists
  Eigen::Vector3d low_m_;
  Eigen::Vector3d high_m_;
  std::array<double, kSizeBins> sizes_{};  // how many of each, blurred by a bin to each side
  double log_smallest_ = 0.0;              // of the diameters counted
  double log_span_ = 1.0;
};

}  // namespace dottrack::acquisition
