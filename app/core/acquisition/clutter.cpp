#include "app/core/acquisition/clutter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/core/acquisition/evidence.h"

namespace dottrack::acquisition {
namespace {

using Eigen::Vector3d;

// A density is taken from so many neighbours: fewer are too random, more are not near enough to
// show a cluster.
constexpr std::size_t kNeighbours = 8;

// Layers that a floor or a table may show in, half their heights; the thinner must be clearly
// denser than what is around it, or it is chance that makes it so.
constexpr std::array<double, 2> kHalfLayers_m = {0.05, 0.015};
constexpr double kDenser = 3.0;

// Neighbours closer than this are no longer told apart.
constexpr double kLeastReach_m = 0.02;

// A room is at least so large, width, depth and height.
const Vector3d& least_room_m() {
  static const Vector3d kLeast(2.0, 2.0, 1.0);
  return kLeast;
}

// Diameters within these factors of the target's smallest and largest are told apart.
constexpr double kSmallestSize = 0.5;
constexpr double kLargestSize = 2.0;
// How much the belief that clutter may have any size weighs against what is there.
constexpr double kAnySize = 4.0;

bool shares_a_sighting(const Finalist& a, const Finalist& b) {
  const CameraSet both(static_cast<std::uint16_t>(a.cameras.bits() & b.cameras.bits()));
  if (both.empty()) return false;
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    if (both.contains(camera) && a.sighting[camera] == b.sighting[camera]) return true;
  }
  return false;
}

bool is_splinter(const Finalist& finalist, std::span<const Witness> witnesses,
                 std::span<const Finalist> finalists) {
  return std::any_of(witnesses.begin(), witnesses.end(), [&](const Witness& w) {
    const double reach_m = w.diameter_m;
    return (finalist.position_m - w.position_m).squaredNorm() <= reach_m * reach_m ||
           (w.finalist < finalists.size() && shares_a_sighting(finalist, finalists[w.finalist]));
  });
}

// The smallest few of the distances it is shown.
class Nearest {
 public:
  Nearest() { distance_.fill(std::numeric_limits<double>::infinity()); }
  void see(double distance) {
    ++seen_;
    if (distance >= distance_.back()) return;
    std::size_t i = distance_.size() - 1;
    for (; i > 0 && distance_[i - 1] > distance; --i) distance_[i] = distance_[i - 1];
    distance_[i] = distance;
  }
  std::size_t seen() const { return seen_; }
  double furthest() const { return distance_.back(); }

 private:
  std::array<double, kNeighbours> distance_{};
  std::size_t seen_ = 0;
};

}  // namespace

Clutter::Clutter(const core::Target& target, std::span<const Witness> witnesses,
                 std::span<const Finalist> finalists)
    : finalists_(finalists.first(std::min(finalists.size(), core::kMaxFinalists))),
      log_smallest_(std::log(kSmallestSize * core::smallest_dot_diameter_m(target))),
      log_span_(std::log(kLargestSize * core::largest_dot_diameter_m(target)) - log_smallest_) {
  for (std::size_t i = 0; i < finalists_.size(); ++i) {
    if (is_splinter(finalists_[i], witnesses, finalists_)) continue;
    clutter_.push_back(static_cast<std::uint16_t>(i));
  }
  set_room();
  count_sizes();
}

void Clutter::set_room() {
  low_m_ = Vector3d::Constant(std::numeric_limits<double>::infinity());
  high_m_ = -low_m_;
  for (const Finalist& f : finalists_) {
    low_m_ = low_m_.cwiseMin(f.position_m);
    high_m_ = high_m_.cwiseMax(f.position_m);
  }
  if (finalists_.empty()) low_m_ = high_m_ = Vector3d::Zero();
  const Vector3d lacking = (least_room_m() - (high_m_ - low_m_)).cwiseMax(0.0);
  low_m_ -= 0.5 * lacking;
  high_m_ += 0.5 * lacking;
}

double Clutter::room_m3() const {
  return (high_m_ - low_m_).prod();
}

// Of the part of the box that is in the room.
double Clutter::box_m3(const Vector3d& at, double half_width_m, double half_height_m) const {
  const Vector3d half(half_width_m, half_width_m, half_height_m);
  return ((at + half).cwiseMin(high_m_) - (at - half).cwiseMax(low_m_)).prod();
}

// In a cube for a layer of no bound, else in a layer of this half height.
double Clutter::nearest_per_m3(const Vector3d& at, int views, double layer_m) const {
  Nearest nearest;
  for (const std::uint16_t i : clutter_) {
    const Finalist& f = finalists_[i];
    if (f.cameras.size() < views) continue;
    const Vector3d off = (f.position_m - at).cwiseAbs();
    if (off.z() > layer_m) continue;
    const double level = std::max(off.x(), off.y());
    nearest.see(std::isfinite(layer_m) ? level : std::max(level, off.z()));
  }
  if (nearest.seen() < kNeighbours) {
    return std::isfinite(layer_m) ? 0.0 : (static_cast<double>(nearest.seen()) + 1.0) / room_m3();
  }
  const double reach_m = std::max(nearest.furthest(), kLeastReach_m);
  return static_cast<double>(kNeighbours) / box_m3(at, reach_m, std::min(layer_m, reach_m));
}

double Clutter::density_per_m3(const Vector3d& position_m, int views) const {
  double density = nearest_per_m3(position_m, views, std::numeric_limits<double>::infinity());
  for (const double layer_m : kHalfLayers_m) {
    const double layered = nearest_per_m3(position_m, views, layer_m);
    if (layered > kDenser * density) density = layered;
  }
  return density;
}

// As a number of bins from the smallest size, within the bins there are.
double Clutter::size_bin(double diameter_m) const {
  if (!(diameter_m > 0.0)) return 0.0;
  const double part = (std::log(diameter_m) - log_smallest_) / log_span_;
  return std::clamp(part * static_cast<double>(kSizeBins), 0.0,
                    static_cast<double>(kSizeBins) - 1e-6);
}

void Clutter::count_sizes() {
  for (const std::uint16_t i : clutter_) {
    const auto bin = static_cast<std::size_t>(size_bin(finalists_[i].diameter_m));
    sizes_[bin] += 0.5;
    sizes_[bin > 0 ? bin - 1 : 0] += 0.25;
    sizes_[std::min(bin + 1, kSizeBins - 1)] += 0.25;
  }
}

double Clutter::log_size_density(double diameter_m) const {
  const double any = kAnySize / static_cast<double>(kSizeBins);
  const double there = sizes_[static_cast<std::size_t>(size_bin(diameter_m))];
  const double share = (there + any) / (static_cast<double>(clutter_.size()) + kAnySize);
  return std::log(share * static_cast<double>(kSizeBins) / log_span_);
}

}  // namespace dottrack::acquisition
