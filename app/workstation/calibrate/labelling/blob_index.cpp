#include "app/workstation/calibrate/labelling/blob_index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dottrack::calibrate {

BlobIndex::BlobIndex(std::span<const Eigen::Vector2d> pixels, std::span<const int> layers,
                     int width_px, int height_px)
    : pixels_(pixels.begin(), pixels.end()), layers_(layers.begin(), layers.end()) {
  for (const int layer : layers_) {
    const auto l = static_cast<std::size_t>(layer);
    if (l >= counts_.size()) counts_.resize(l + 1, 0);
    ++counts_[l];
  }
  const std::size_t most = counts_.empty() ? 1 : *std::max_element(counts_.begin(), counts_.end());
  area_px_ = static_cast<double>(width_px) * height_px;
  cell_px_ = std::clamp(std::sqrt(area_px_ / static_cast<double>(std::max<std::size_t>(most, 1))),
                        4.0, 256.0);
  columns_ = static_cast<int>(width_px / cell_px_) + 1;
  rows_ = static_cast<int>(height_px / cell_px_) + 1;
  begin_.assign(cell(static_cast<int>(counts_.size()), 0, 0) + 1, 0);
  const auto cell_of = [&](std::size_t i) {
    return cell(layers_[i], column_of(pixels_[i].x()), row_of(pixels_[i].y()));
  };
  for (std::size_t i = 0; i < pixels_.size(); ++i) ++begin_[cell_of(i) + 1];
  for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
  order_.resize(pixels_.size());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < pixels_.size(); ++i) order_[next[cell_of(i)]++] = static_cast<int>(i);
}

std::size_t BlobIndex::cell(int layer, int column, int row) const {
  const auto l = static_cast<std::size_t>(layer);
  return (l * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(row)) *
             static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

int BlobIndex::column_of(double x) const {
  return static_cast<int>(std::clamp(x / cell_px_, 0.0, columns_ - 1.0));
}

int BlobIndex::row_of(double y) const {
  return static_cast<int>(std::clamp(y / cell_px_, 0.0, rows_ - 1.0));
}

template <class Take>
void BlobIndex::visit(int layer, const Eigen::Vector2d& at, double within_px, Take take) const {
  if (layer < 0 || static_cast<std::size_t>(layer) >= counts_.size()) return;
  const int last_column = column_of(at.x() + within_px);
  const int last_row = row_of(at.y() + within_px);
  for (int row = row_of(at.y() - within_px); row <= last_row; ++row) {
    for (int column = column_of(at.x() - within_px); column <= last_column; ++column) {
      const std::size_t c = cell(layer, column, row);
      for (std::size_t i = begin_[c]; i < begin_[c + 1]; ++i) {
        const auto blob = static_cast<std::size_t>(order_[i]);
        take(order_[i], (pixels_[blob] - at).squaredNorm());
      }
    }
  }
}

int BlobIndex::nearest(int layer, const Eigen::Vector2d& at, double within_px) const {
  int best = -1;
  double least = within_px * within_px;
  visit(layer, at, within_px, [&](int blob, double squared) {
    if (squared < least || (squared == least && blob < best)) {
      best = blob;
      least = squared;
    }
  });
  return best;
}

std::vector<int> BlobIndex::neighbours(int i, std::size_t k) const {
  std::vector<std::pair<double, int>> found;
  const auto self = static_cast<std::size_t>(i);
  const double most = cell_px_ * (columns_ + rows_);
  for (double reach = 1.5 * cell_px_; reach < 2.0 * most; reach *= 2.0) {
    found.clear();
    visit(layers_[self], pixels_[self], reach, [&](int blob, double squared) {
      if (blob != i && squared <= reach * reach) found.emplace_back(squared, blob);
    });
    if (found.size() >= k) break;
  }
  std::sort(found.begin(), found.end());
  std::vector<int> nearest;
  for (std::size_t n = 0; n < std::min(k, found.size()); ++n) nearest.push_back(found[n].second);
  return nearest;
}

double BlobIndex::density(int layer) const {
  const auto l = static_cast<std::size_t>(layer);
  return layer < 0 || l >= counts_.size() ? 0.0 : static_cast<double>(counts_[l]) / area_px_;
}

}  // namespace dottrack::calibrate
