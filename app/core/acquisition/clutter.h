#pragma once
// How many finalists there are by chance: around a candidate's dots, seen by how many cameras, how
// large.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "app/core/acquisition/finalists.h"
#include "app/core/limits.h"
#include "app/core/rig.h"

namespace dottrack::acquisition {

struct Witness;

// The smallest few of the distances it is shown.
class Nearest {
 public:
  // A density is taken from so many neighbours: fewer are too random, more are not near enough to
  // show a cluster.
  static constexpr std::size_t kCapacity = 8;

  Nearest();
  void see(double distance_m) {
    ++seen_;
    if (distance_m < distance_m_.back()) insert(distance_m);
  }
  std::size_t seen() const { return seen_; }
  // The k-th, from 1; of at least k seen.
  double distance_m(std::size_t k) const { return distance_m_[k - 1]; }

 private:
  void insert(double distance_m);

  std::array<double, kCapacity> distance_m_;
  std::size_t seen_ = 0;
};

// All finalists but the candidate's own and their splinters: those that share one of its sightings
// or lie within a dot of its own. Takes one pass over the finalists; keeps nothing of them.
class Clutter {
 public:
  Clutter(const core::Target& target, std::span<const Witness> witnesses,
          std::span<const Finalist> finalists);

  // The box that holds all finalists, a room at the least.
  double room_m3() const { return (high_m_ - low_m_).prod(); }

  // Finalists per cubic metre at this witness's place, seen by at least as many cameras as it. From
  // the nearest ones in a cube around it, fewer of them where they crowd; where they lie in a level
  // plane, a floor or a table, from those in a thin layer. Where there are hardly any, of the whole
  // room, and never nothing.
  double density_per_m3(std::size_t witness) const;

  // Natural logarithm of the density of diameters, per unit of the diameter's logarithm.
  double log_size_density(double diameter_m) const;

 private:
  static constexpr std::size_t kSizeBins = 32;
  static constexpr std::size_t kLayers = 2;

  struct Neighbourhood {
    Eigen::Vector3d at_m = Eigen::Vector3d::Zero();
    int views = 0;
    Nearest around;  // in a cube
    std::array<Nearest, kLayers> level;

    void see(const Eigen::Vector3d& position_m);
  };
  // Of every number of views, and of at least the witness's.
  struct Neighbourhoods {
    Neighbourhood any;
    Neighbourhood as_many;
  };

  void set_room(std::span<const Finalist> finalists);
  void take(const Finalist& finalist);
  double box_m3(const Eigen::Vector3d& at_m, double half_width_m, double half_height_m) const;
  double cube_density(const Neighbourhood& near) const;
  double density(const Neighbourhood& near) const;
  double size_bin(double diameter_m) const;

  Eigen::Vector3d low_m_;
  Eigen::Vector3d high_m_;
  StaticVector<Neighbourhoods, core::kMaxDots> near_;  // by witness
  std::array<double, kSizeBins> sizes_{};  // how many of each, blurred by a bin to each side
  double total_ = 0.0;
  double log_smallest_;  // of the diameters counted
  double log_span_;
};

}  // namespace dottrack::acquisition
