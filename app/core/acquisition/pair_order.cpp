#include "app/core/acquisition/pair_order.h"

#include <algorithm>

namespace dottrack::acquisition {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Two cameras closer to each other than this part of their reach see a dot under so small an angle
// that they are not relied on to find it.
constexpr double kMinBaselinePart = 0.01;

// A camera's field of view is sampled on this grid, at these parts of its range.
constexpr int kColumns = 5;
constexpr int kRows = 4;
constexpr std::array<double, 3> kRangeParts = {0.25, 0.5, 0.85};

constexpr int kImprovements = 8;  // rounds of exchanging cameras between groups
constexpr int kSamePlaceCost = 1'000'000;

// Grows with the overlap; two cameras always cost a little together.
constexpr int kBaseCost = 1;

bool sees(const core::Camera& camera, const Vector3d& point_m) {
  Vector2d pixel;
  if (geometry::project(camera.model, point_m, pixel) != geometry::OpticsStatus::ok) return false;
  const double range_m = (point_m - geometry::centre(camera.model)).norm();
  return pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < camera.width_px &&
         pixel.y() < camera.height_px && range_m >= camera.distance_min_m &&
         range_m <= camera.distance_max_m;
}

// How many of a's samples b sees too.
int shared(const core::Camera& a, const core::Camera& b) {
  int count = 0;
  for (int cell = 0; cell < kColumns * kRows; ++cell) {
    const int column = cell % kColumns;
    const int row = cell / kColumns;
    geometry::Ray ray;
    const Vector2d pixel((column + 0.5) * a.width_px / kColumns, (row + 0.5) * a.height_px / kRows);
    if (geometry::unproject(a.model, pixel, ray) != geometry::OpticsStatus::ok) continue;
    for (const double part : kRangeParts) {
      const double range_m = a.distance_min_m + part * (a.distance_max_m - a.distance_min_m);
      count += sees(b, ray.origin + range_m * ray.direction) ? 1 : 0;
    }
  }
  return count;
}

bool same_model(const geometry::CameraModel& a, const geometry::CameraModel& b) {
  constexpr double kPixelApart = 1e-3;
  if (a.index() != b.index() || geometry::centre(a) != geometry::centre(b)) return false;
  const auto axes_equal = [](const auto& m, const auto& n) {
    return (m.a - n.a).norm() == 0.0 && (m.h - n.h).norm() < kPixelApart &&
           (m.v - n.v).norm() < kPixelApart;
  };
  if (const auto* m = std::get_if<geometry::Cahv>(&a)) {
    return axes_equal(*m, *std::get_if<geometry::Cahv>(&b));
  }
  if (const auto* m = std::get_if<geometry::Cahvor>(&a)) {
    return axes_equal(*m, *std::get_if<geometry::Cahvor>(&b));
  }
  return axes_equal(*std::get_if<geometry::Cahvore>(&a), *std::get_if<geometry::Cahvore>(&b));
}

}  // namespace

void PairOrder::start(std::span<const CameraView> views) {
  seeing_ = CameraSet{};
  bool known = measured_count_ == views.size();
  for (std::size_t c = 0; c < views.size(); ++c) {
    if (!views[c].sightings.empty()) seeing_.insert(c);
    known = known && same_model(measured_[c], views[c].camera->model);
  }
  if (known) return;
  measured_count_ = views.size();
  for (std::size_t c = 0; c < views.size(); ++c) measured_[c] = views[c].camera->model;
  measure_overlap(views);
  find_places(views);
  known_ = {};
}

void PairOrder::measure_overlap(std::span<const CameraView> views) {
  for (std::size_t a = 0; a < views.size(); ++a) {
    for (std::size_t b = a + 1; b < views.size(); ++b) {
      const int both =
          shared(*views[a].camera, *views[b].camera) + shared(*views[b].camera, *views[a].camera);
      overlap_[a][b] = overlap_[b][a] = kBaseCost + both;
    }
  }
}

void PairOrder::find_places(std::span<const CameraView> views) {
  const auto at_one_place = [&](std::size_t a, std::size_t b) {
    const core::Camera& one = *views[a].camera;
    const core::Camera& other = *views[b].camera;
    return (geometry::centre(one.model) - geometry::centre(other.model)).norm() <
           kMinBaselinePart * std::max(one.distance_max_m, other.distance_max_m);
  };
  for (std::size_t c = 0; c < views.size(); ++c) place_[c] = static_cast<std::uint8_t>(c);
  for (std::size_t a = 0; a < views.size(); ++a) {
    for (std::size_t b = a + 1; b < views.size(); ++b) {
      if (place_[a] == place_[b] || !at_one_place(a, b)) continue;
      const std::uint8_t gone = place_[b];
      for (std::size_t c = 0; c < views.size(); ++c) {
        if (place_[c] == gone) place_[c] = place_[a];
      }
    }
  }
}

int PairOrder::cost_in(std::size_t camera, int group, const Groups& groups,
                       const std::array<CameraSet, kMaxCameras>& done) const {
  int cost = 0;
  for (std::size_t c = 0; c < measured_count_; ++c) {
    if (c == camera || !seeing_.contains(c) || groups[c] != group) continue;
    if (place_[c] == place_[camera]) {
      cost += kSamePlaceCost;
    } else if (!done[std::min(c, camera)].contains(std::max(c, camera))) {
      cost += overlap_[camera][c];
    }
  }
  return cost;
}

// Cameras are dealt out one by one to the group where they cost least, then exchanged and moved as
// long as that costs less still.
PairOrder::Groups PairOrder::grouped(int groups,
                                     const std::array<CameraSet, kMaxCameras>& done) const {
  constexpr std::uint8_t kNowhere = 0xFF;
  Groups result;
  result.fill(kNowhere);
  for (int round = 0; round < 1 + kImprovements; ++round) {
    bool changed = false;
    for (std::size_t c = 0; c < measured_count_; ++c) {
      if (!seeing_.contains(c)) continue;
      int best = result[c] == kNowhere ? 0 : result[c];
      int least = cost_in(c, best, result, done);
      for (int g = 0; g < groups; ++g) {
        const int cost = cost_in(c, g, result, done);
        if (cost >= least) continue;
        least = cost;
        best = g;
      }
      changed = changed || result[c] != best;
      result[c] = static_cast<std::uint8_t>(best);
    }
    for (std::size_t a = 0; a < measured_count_; ++a) {
      for (std::size_t b = a + 1; b < measured_count_; ++b) {
        if (!seeing_.contains(a) || !seeing_.contains(b) || result[a] == result[b]) continue;
        const int before =
            cost_in(a, result[a], result, done) + cost_in(b, result[b], result, done);
        std::swap(result[a], result[b]);
        const int after = cost_in(a, result[a], result, done) + cost_in(b, result[b], result, done);
        if (after < before) {
          changed = true;
        } else {
          std::swap(result[a], result[b]);
        }
      }
    }
    if (!changed) break;
  }
  return result;
}

// The most cameras, of more than one place, no two of which form a pair inside a group.
int PairOrder::largest_miss(int count, const Groups& groups) const {
  int total = 0;
  for (int g = 0; g < count; ++g) {
    std::array<int, kMaxCameras> at_place{};
    int most = 0;
    for (std::size_t c = 0; c < measured_count_; ++c) {
      if (!seeing_.contains(c) || groups[c] != g) continue;
      most = std::max(most, ++at_place[place_[c]]);
    }
    total += most;
  }
  return total;
}

// All in one group where no groups do.
PairOrder::Groups PairOrder::groups_for(int min_views,
                                        const std::array<CameraSet, kMaxCameras>& done) const {
  for (int count = min_views - 1; count > 1; --count) {
    const Groups groups = grouped(count, done);
    if (largest_miss(count, groups) < min_views) return groups;
  }
  return {};
}

void PairOrder::list(int min_views, const std::array<CameraSet, kMaxCameras>& done,
                     CameraPairs& pairs) {
  pairs.clear();
  Known& known = known_[static_cast<std::size_t>(min_views)];
  if (!known.any || known.seeing != seeing_ || known.done != done) {
    known = {true, seeing_, done, groups_for(min_views, done)};
  }
  for (std::size_t a = 0; a < measured_count_; ++a) {
    for (std::size_t b = a + 1; b < measured_count_; ++b) {
      if (!seeing_.contains(a) || !seeing_.contains(b) || known.groups[a] != known.groups[b]) {
        continue;
      }
      if (done[a].contains(b)) continue;
      pairs.push_back({static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)});
    }
  }
}

}  // namespace dottrack::acquisition
