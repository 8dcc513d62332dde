#include "app/core/acquisition/view_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dottrack::acquisition {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using estimation::Sighting;

constexpr int kMostCellsOfOne = 16;  // sightings over more cells are looked at for every point

}  // namespace

bool same_views(const PointViews& a, const PointViews& b) {
  if (a.cameras != b.cameras) return false;
  for (std::size_t c = 0; c < kMaxCameras; ++c) {
    if (a.cameras.contains(c) && a.sighting[c] != b.sighting[c]) return false;
  }
  return true;
}

void SightingIndex::build(const CameraView& view) {
  view_ = &view;
  choose_cells(view);
  std::fill_n(heads_.begin(), columns_ * rows_, kNone);
  entries_.clear();
  large_.clear();
  for (std::size_t i = 0; i < view.sightings.size(); ++i) {
    const Sighting& s = view.sightings[i];
    const Vector2d slack =
        kWidenPart * (s.box_max_px - s.box_min_px) + Vector2d::Constant(kWiden_px);
    outlines_[i] = {s.box_min_px - slack, s.box_max_px + slack, s.pixel, s.window.near_m,
                    s.window.far_m};
    insert(static_cast<std::uint16_t>(i));
  }
}

// Cells about as wide as a widened box is on average, but not more of them than there is room for.
void SightingIndex::choose_cells(const CameraView& view) {
  double extent_px = 0.0;
  for (const Sighting& s : view.sightings) extent_px += (s.box_max_px - s.box_min_px).sum();
  const double mean_px = 0.5 * extent_px / static_cast<double>(view.sightings.size());
  const double wide = (1.0 + 2.0 * kWidenPart) * mean_px + 2.0 * kWiden_px;
  const double area = static_cast<double>(view.camera->width_px) * view.camera->height_px;
  const double least = 1.1 * std::sqrt(area / static_cast<double>(kCells)) + 1.0;
  const double cell_px = std::max(wide, least);
  cells_per_px_ = 1.0 / cell_px;
  columns_ = static_cast<int>(view.camera->width_px / cell_px) + 1;
  rows_ = static_cast<int>(view.camera->height_px / cell_px) + 1;
  while (static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) > kCells) {
    cells_per_px_ *= 0.5;  // long and narrow images
    columns_ = columns_ / 2 + 1;
    rows_ = rows_ / 2 + 1;
  }
}

// Pixels outside the image belong to the cells at its border.
int SightingIndex::column(double x) const {
  return static_cast<int>(std::clamp(x * cells_per_px_, 0.0, static_cast<double>(columns_ - 1)));
}

int SightingIndex::row(double y) const {
  return static_cast<int>(std::clamp(y * cells_per_px_, 0.0, static_cast<double>(rows_ - 1)));
}

void SightingIndex::insert(std::uint16_t sighting) {
  const Outline& box = outlines_[sighting];
  const int c0 = column(box.min_px.x());
  const int c1 = column(box.max_px.x());
  const int r0 = row(box.min_px.y());
  const int r1 = row(box.max_px.y());
  const int cells = (c1 - c0 + 1) * (r1 - r0 + 1);
  if (cells > kMostCellsOfOne ||
      entries_.size() + static_cast<std::size_t>(cells) > entries_.capacity()) {
    large_.push_back(sighting);
    return;
  }
  for (int r = r0; r <= r1; ++r) {
    for (int c = c0; c <= c1; ++c) {
      std::uint16_t& head = heads_[static_cast<std::size_t>(r * columns_ + c)];
      entries_.push_back({sighting, head});
      head = static_cast<std::uint16_t>(entries_.size() - 1);
    }
  }
}

void SightingIndex::judge(std::uint16_t sighting, const Vector2d& pixel, const Vector3d& point_m,
                          double& least2, std::uint16_t& best) const {
  const Outline& box = outlines_[sighting];
  if (!(pixel.x() >= box.min_px.x() && pixel.x() <= box.max_px.x() && pixel.y() >= box.min_px.y() &&
        pixel.y() <= box.max_px.y())) {
    return;
  }
  const double distance2 = (pixel - box.pixel).squaredNorm();
  if (distance2 > least2 || (distance2 == least2 && sighting > best)) return;
  const double range_m = (point_m - view_->sightings[sighting].line.ray.origin).norm();
  if (range_m < box.near_m || range_m > box.far_m) return;
  least2 = distance2;
  best = sighting;
}

std::uint16_t SightingIndex::closest(const Vector2d& pixel, const Vector3d& point_m) const {
  double least2 = std::numeric_limits<double>::infinity();
  std::uint16_t best = kNone;
  const auto cell = static_cast<std::size_t>(row(pixel.y()) * columns_ + column(pixel.x()));
  for (std::uint16_t e = heads_[cell]; e != kNone; e = entries_[e].next) {
    judge(entries_[e].sighting, pixel, point_m, least2, best);
  }
  for (const std::uint16_t sighting : large_) judge(sighting, pixel, point_m, least2, best);
  return best;
}

void ViewFinder::start(std::span<const CameraView> views) {
  views_ = views;
  seeing_ = CameraSet{};
  for (std::size_t c = 0; c < views.size(); ++c) {
    if (views[c].sightings.empty()) continue;
    seeing_.insert(c);
    index_[c].build(views[c]);
  }
}

PointViews ViewFinder::views_of(const Vector3d& point_m, int enough,
                                const PointViews& known) const {
  PointViews found = known;
  int left = seeing_.size() - known.cameras.size();
  for (std::size_t c = 0; c < views_.size() && found.cameras.size() + left >= enough; ++c) {
    if (!seeing_.contains(c) || known.cameras.contains(c)) continue;
    --left;
    Vector2d pixel;
    if (geometry::project(views_[c].camera->model, point_m, pixel) != geometry::OpticsStatus::ok) {
      continue;
    }
    const std::uint16_t sighting = index_[c].closest(pixel, point_m);
    if (sighting != SightingIndex::kNone) found.set(c, sighting);
  }
  return found;
}

}  // namespace dottrack::acquisition
