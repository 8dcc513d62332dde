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

std::uint16_t SightingIndex::closest(const Vector2d& pixel, const Vector3d& point_m,
                                     double radius_px) const {
  constexpr double kFarAway_px = 1e6;
  std::uint16_t best = kNone;
  if (!(pixel.cwiseAbs().maxCoeff() < kFarAway_px)) return best;
  double least2 = radius_px * radius_px;
  const auto judge = [&](std::uint16_t i) {
    const Sighting& s = view_->sightings[i];
    const double distance2 = (pixel - s.pixel).squaredNorm();
    if (distance2 > least2 || (distance2 == least2 && i > best)) return;
    if (!s.box_contains(pixel, kWidenPart, kWiden_px)) return;
    if (!s.window.contains((point_m - s.line.ray.origin).norm())) return;
    least2 = distance2;
    best = i;
  };
  const double reach = std::min(radius_px, reach_px_);
  const int c0 = column(pixel.x() - reach);
  const int c1 = column(pixel.x() + reach);
  const int r1 = row(pixel.y() + reach);
  for (int r = row(pixel.y() - reach); r <= r1; ++r) {
    for (int c = c0; c <= c1; ++c) {
      for (std::uint16_t i = heads_[static_cast<std::size_t>(r * columns_ + c)]; i != kNone;
           i = next_[i]) {
        judge(i);
      }
    }
  }
  for (const std::uint16_t i : large_) judge(i);
  return best;
}

}  // namespace dottrack::acquisition
