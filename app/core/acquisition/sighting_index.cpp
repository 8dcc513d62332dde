#include "app/core/acquisition/sighting_index.h"

#include <algorithm>
#include <cmath>

namespace dottrack::acquisition {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using estimation::Sighting;

constexpr double kLeastCell_px = 16.0;
constexpr double kCellsOfOne = 2.0;  // that a sighting may reach across

// From the centre to the furthest edge of the widened box, across or down.
double reach_px(const Sighting& s) {
  const Vector2d size = s.box_max_px - s.box_min_px;
  const Vector2d reach = (s.box_max_px - s.pixel).cwiseMax(s.pixel - s.box_min_px);
  return (reach + kWidenPart * size).maxCoeff() + kWiden_px;
}

}  // namespace

void SightingIndex::build(const CameraView& view) {
  view_ = &view;
  const std::size_t size = view.sightings.size();
  std::array<double, core::kMaxRegions> reach;
  double sum_px = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    const Sighting& sighting = view.sightings[i];
    x_[i] = static_cast<float>(sighting.pixel.x());
    y_[i] = static_cast<float>(sighting.pixel.y());
    const double px = reach_px(sighting);
    reach[i] = px;
    sum_px += px;
  }
  choose_cells(*view.camera, sum_px / static_cast<double>(size));
  std::fill_n(heads_.begin(), columns_ * rows_, kNone);
  large_.clear();
  reach_px_ = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    const double px = reach[i];
    if (px * cells_per_px_ > kCellsOfOne) {
      large_.push_back(static_cast<std::uint16_t>(i));
      continue;
    }
    reach_px_ = std::max(reach_px_, px);
    const auto cell = static_cast<std::size_t>(row(view.sightings[i].pixel.y()) * columns_ +
                                               column(view.sightings[i].pixel.x()));
    next_[i] = heads_[cell];
    heads_[cell] = static_cast<std::uint16_t>(i);
  }
}

// Cells about as wide as a widened box is on average, but not more of them than there is room for.
void SightingIndex::choose_cells(const core::Camera& camera, double mean_reach_px) {
  double cell_px = std::max(kLeastCell_px, 2.0 * mean_reach_px);
  const auto cells = [&](int size_px) { return static_cast<int>(size_px / cell_px) + 1; };
  while (static_cast<std::size_t>(cells(camera.width_px)) *
             static_cast<std::size_t>(cells(camera.height_px)) >
         kCells) {
    cell_px *= 2.0;
  }
  cells_per_px_ = 1.0 / cell_px;
  columns_ = cells(camera.width_px);
  rows_ = cells(camera.height_px);
}

// Pixels outside the image belong to the cells at its border.
int SightingIndex::column(double x) const {
  return std::clamp(static_cast<int>(x * cells_per_px_), 0, columns_ - 1);
}

int SightingIndex::row(double y) const {
  return std::clamp(static_cast<int>(y * cells_per_px_), 0, rows_ - 1);
}

template <class Visit>
bool SightingIndex::visit_near(double x_px, double y_px, double reach_px,
                               const Visit& visit) const {
  const int c0 = column(x_px - reach_px);
  const int c1 = column(x_px + reach_px);
  const int r1 = row(y_px + reach_px);
  for (int r = row(y_px - reach_px); r <= r1; ++r) {
    for (int c = c0; c <= c1; ++c) {
      for (std::uint16_t i = heads_[static_cast<std::size_t>(r * columns_ + c)]; i != kNone;
           i = next_[i]) {
        if (visit(i)) return true;
      }
    }
  }
  for (const std::uint16_t i : large_) {
    if (visit(i)) return true;
  }
  return false;
}

bool SightingIndex::is_near(float x_px, float y_px, float radius_px) const {
  const auto reach = static_cast<double>(radius_px);
  return visit_near(static_cast<double>(x_px), static_cast<double>(y_px), reach,
                    [&](std::uint16_t i) {
                      const float dx = x_[i] - x_px;
                      const float dy = y_[i] - y_px;
                      return dx * dx + dy * dy <= radius_px * radius_px;
                    });
}

std::uint16_t SightingIndex::closest(const Vector2d& pixel, const Vector3d& point_m,
                                     double radius_px) const {
  constexpr double kFarAway_px = 1e6;
  std::uint16_t best = kNone;
  if (!(pixel.cwiseAbs().maxCoeff() < kFarAway_px)) return best;
  double least2 = radius_px * radius_px;
  visit_near(pixel.x(), pixel.y(), std::min(radius_px, reach_px_), [&](std::uint16_t i) {
    const Sighting& s = view_->sightings[i];
    const double distance2 = (pixel - s.pixel).squaredNorm();
    if (distance2 > least2 || (distance2 == least2 && i > best)) return false;
    if (!s.box_contains(pixel, kWidenPart, kWiden_px)) return false;
    if (!s.window.contains((point_m - s.line.ray.origin).norm())) return false;
    least2 = distance2;
    best = i;
    return false;
  });
  return best;
}

}  // namespace dottrack::acquisition
