#include "app/core/acquisition/clutter.h"

#include <algorithm>
#include <bit>
#include <bitset>
#include <cmath>
#include <limits>

#include "app/core/acquisition/evidence.h"

namespace dottrack::acquisition {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Layers that a floor or a table may show in, half their heights.
constexpr std::array<double, 2> kHalfLayers_m = {0.05, 0.015};

// A layer, or fewer neighbours, must show a density so many times as large to be believed: less may
// be chance.
constexpr double kDenser = 3.0;

// Neighbours closer than this are no longer told apart.
constexpr double kLeastReach_m = 0.02;

// A room is at least so large, width, depth and height.
constexpr std::array<double, 3> kLeastRoom_m = {2.0, 2.0, 1.0};

// Diameters within these factors of the target's smallest and largest are told apart.
constexpr double kSmallestSize = 0.5;
constexpr double kLargestSize = 2.0;
// How much the belief that clutter may have any size weighs against what is there.
constexpr double kAnySize = 4.0;

// The sightings of a candidate's finalists, to ask quickly whether another has one of them.
class OwnSightings {
 public:
  OwnSightings(std::span<const Witness> witnesses, std::span<const Finalist> finalists) {
    for (const Witness& w : witnesses) {
      if (w.finalist < finalists.size()) add(finalists[w.finalist]);
    }
  }

  bool any_of(const Finalist& finalist) const {
    for (unsigned left = finalist.cameras.bits() & cameras_; left != 0; left &= left - 1) {
      const auto camera = static_cast<std::size_t>(std::countr_zero(left));
      if (own_[camera].test(finalist.sighting[camera])) return true;
    }
    return false;
  }

 private:
  void add(const Finalist& finalist) {
    for (unsigned left = finalist.cameras.bits(); left != 0; left &= left - 1) {
      const auto camera = static_cast<std::size_t>(std::countr_zero(left));
      own_[camera].set(finalist.sighting[camera]);
    }
    cameras_ |= finalist.cameras.bits();
  }

  unsigned cameras_ = 0;
  std::array<std::bitset<core::kMaxRegions>, kMaxCameras> own_{};
};

bool is_close(const Finalist& finalist, std::span<const Witness> witnesses) {
  return std::any_of(witnesses.begin(), witnesses.end(), [&](const Witness& w) {
    return (finalist.position_m - w.position_m).squaredNorm() <= w.diameter_m * w.diameter_m;
  });
}

}  // namespace

Nearest::Nearest() {
  distance_m_.fill(kInfinity);
}

void Nearest::insert(double distance_m) {
  std::size_t i = kCapacity - 1;
  for (; i > 0 && distance_m_[i - 1] > distance_m; --i) distance_m_[i] = distance_m_[i - 1];
  distance_m_[i] = distance_m;
}

void Clutter::Neighbourhood::see(const Vector3d& position_m) {
  const Vector3d off_m = (position_m - at_m).cwiseAbs();
  const double across_m = std::max(off_m.x(), off_m.y());
  around.see(std::max(across_m, off_m.z()));
  for (std::size_t i = 0; i < kLayers; ++i) {
    if (off_m.z() <= kHalfLayers_m[i]) level[i].see(across_m);
  }
}

Clutter::Clutter(const core::Target& target, std::span<const Witness> witnesses,
                 std::span<const Finalist> finalists)
    : log_smallest_(std::log(kSmallestSize * core::smallest_dot_diameter_m(target))),
      log_span_(std::log(kLargestSize * core::largest_dot_diameter_m(target)) - log_smallest_) {
  for (const Witness& w : witnesses) {
    near_.emplace_back();
    near_.back().any.at_m = near_.back().as_many.at_m = w.position_m;
    near_.back().as_many.views = w.views;
  }
  set_room(finalists);
  const OwnSightings own(witnesses, finalists);
  for (const Finalist& f : finalists) {
    if (!own.any_of(f) && !is_close(f, witnesses)) take(f);
  }
}

void Clutter::set_room(std::span<const Finalist> finalists) {
  low_m_ = Vector3d::Constant(kInfinity);
  high_m_ = -low_m_;
  for (const Finalist& f : finalists) {
    low_m_ = low_m_.cwiseMin(f.position_m);
    high_m_ = high_m_.cwiseMax(f.position_m);
  }
  if (finalists.empty()) low_m_ = high_m_ = Vector3d::Zero();
  const Vector3d least_m(kLeastRoom_m[0], kLeastRoom_m[1], kLeastRoom_m[2]);
  const Vector3d lacking_m = (least_m - (high_m_ - low_m_)).cwiseMax(0.0);
  low_m_ -= 0.5 * lacking_m;
  high_m_ += 0.5 * lacking_m;
}

void Clutter::take(const Finalist& finalist) {
  for (Neighbourhoods& near : near_) {
    near.any.see(finalist.position_m);
    if (finalist.cameras.size() >= near.as_many.views) near.as_many.see(finalist.position_m);
  }
  const auto bin = static_cast<std::size_t>(size_bin(finalist.diameter_m));
  sizes_[bin] += 0.5;
  sizes_[bin > 0 ? bin - 1 : 0] += 0.25;
  sizes_[std::min(bin + 1, kSizeBins - 1)] += 0.25;
  total_ += 1.0;
}

// Of the part of the box that is in the room.
double Clutter::box_m3(const Vector3d& at_m, double half_width_m, double half_height_m) const {
  const Vector3d half_m(half_width_m, half_width_m, half_height_m);
  return ((at_m + half_m).cwiseMin(high_m_) - (at_m - half_m).cwiseMax(low_m_)).prod();
}

double Clutter::cube_density(const Neighbourhood& near) const {
  constexpr std::array<std::size_t, 3> kNeighbours = {Nearest::kCapacity, 4, 2};
  const auto few = static_cast<double>(std::min(near.around.seen(), Nearest::kCapacity));
  double best = (few + 1.0) / room_m3();
  for (const std::size_t k : kNeighbours) {
    if (near.around.seen() < k) continue;
    const double reach_m = std::max(near.around.distance_m(k), kLeastReach_m);
    const double density = static_cast<double>(k) / box_m3(near.at_m, reach_m, reach_m);
    if (k == Nearest::kCapacity || density > kDenser * best) best = density;
  }
  return best;
}

double Clutter::density(const Neighbourhood& near) const {
  double best = cube_density(near);
  for (std::size_t i = 0; i < kLayers; ++i) {
    const Nearest& level = near.level[i];
    if (level.seen() < Nearest::kCapacity) continue;
    const double reach_m = std::max(level.distance_m(Nearest::kCapacity), kLeastReach_m);
    const double height_m = std::min(kHalfLayers_m[i], reach_m);
    const double density =
        static_cast<double>(Nearest::kCapacity) / box_m3(near.at_m, reach_m, height_m);
    if (density > kDenser * best) best = density;
  }
  return best;
}

double Clutter::density_per_m3(std::size_t witness) const {
  const Neighbourhoods& near = near_[witness];
  // Clutter of many views is too rare to show where it crowds: it is taken to crowd where others
  // do.
  const double share = (static_cast<double>(near.as_many.around.seen()) + 1.0) / (total_ + 1.0);
  return std::max(density(near.as_many), share * density(near.any));
}

// As a number of bins from the smallest size, within the bins there are.
double Clutter::size_bin(double diameter_m) const {
  if (!(diameter_m > 0.0)) return 0.0;
  const double part = (std::log(diameter_m) - log_smallest_) / log_span_;
  const auto bins = static_cast<double>(kSizeBins);
  return std::clamp(part * bins, 0.0, bins - 0.5);
}

double Clutter::log_size_density(double diameter_m) const {
  const auto bins = static_cast<double>(kSizeBins);
  const double there = sizes_[static_cast<std::size_t>(size_bin(diameter_m))];
  const double share = (there + kAnySize / bins) / (total_ + kAnySize);
  return std::log(share * bins / log_span_);
}

}  // namespace dottrack::acquisition
