#include "tests/unit/image/plain_background.h"

#include <algorithm>
#include <cmath>

namespace dottrack::image::test {

namespace {

constexpr int kTile_px = 8;

// Where a pixel lies between the middles of two tiles.
struct Place {
  explicit Place(int pixel) : tile((pixel + 4) / 8 - 1), eighths(1 + (pixel + 4) % 8 / 2 * 2) {}

  int tile;
  int eighths;
};

// Between a and b by averages of two, each rounded up.
int up(int a, int b, int eighths) {
  const auto average = [](int p, int q) { return (p + q + 1) / 2; };
  const int half = average(a, b);
  const int quarter = eighths < 4 ? average(a, half) : average(half, b);
  if (eighths == 1) return average(a, quarter);
  if (eighths == 7) return average(quarter, b);
  return average(quarter, half);
}

int down(int a, int b, int eighths) {
  return 255 - up(255 - a, 255 - b, eighths);
}

double between(double a, double b, int eighths) {
  return a + (b - a) * eighths / 8.0;
}

}  // namespace

PlainBackground::PlainBackground(const Picture& picture, const Band& band)
    : picture_(picture),
      polarity_(band.polarity),
      contrast_dn_(band.min_contrast_dn),
      contrast_256ths_(band.min_contrast_256ths),
      reach_(band.background_px / 16),
      columns_((picture.width_px() + kTile_px - 1) / kTile_px),
      rows_((picture.height_px() + kTile_px - 1) / kTile_px),
      means_(static_cast<std::size_t>(columns_ * rows_), -1.0) {}

int PlainBackground::value(int x, int y) const {
  return polarity_ == core::Polarity::bright ? picture_.at(x, y) : 255 - picture_.at(x, y);
}

double PlainBackground::mean_around(int tile_x, int tile_y) const {
  int sum = 0;
  int count = 0;
  for (int y = (tile_y - reach_) * kTile_px; y < (tile_y + reach_ + 1) * kTile_px; ++y) {
    for (int x = (tile_x - reach_) * kTile_px; x < (tile_x + reach_ + 1) * kTile_px; ++x) {
      if (!picture_.contains(x, y)) continue;
      sum += value(x, y);
      ++count;
    }
  }
  // In single precision, and rounded to even, as the tracker does.
  return static_cast<double>(static_cast<float>(sum) * (1.0F / static_cast<float>(count)));
}

double PlainBackground::middle(int tile_x, int tile_y) const {
  const int x = std::clamp(tile_x, 0, columns_ - 1);
  const int y = std::clamp(tile_y, 0, rows_ - 1);
  double& mean = means_[static_cast<std::size_t>(y * columns_ + x)];
  if (mean < 0.0) mean = mean_around(x, y);
  return mean;
}

int PlainBackground::raised(double mean) const {
  const int rounded = static_cast<int>(std::nearbyint(mean));
  const int light = polarity_ == core::Polarity::bright ? rounded : 255 - rounded;
  const double relative = std::floor(light * contrast_256ths_ / 256.0 + 0.5);
  return std::min(rounded + std::max(static_cast<int>(relative) - contrast_dn_, 0), 255);
}

int PlainBackground::at(int x, int y) const {
  const Place px(x);
  const Place py(y);
  const auto rounded = [&](int i, int j) { return raised(middle(px.tile + i, py.tile + j)); };
  return up(down(rounded(0, 0), rounded(1, 0), px.eighths),
            down(rounded(0, 1), rounded(1, 1), px.eighths), py.eighths);
}

double PlainBackground::exact(int x, int y) const {
  const Place px(x);
  const Place py(y);
  return between(
      between(middle(px.tile, py.tile), middle(px.tile + 1, py.tile), px.eighths),
      between(middle(px.tile, py.tile + 1), middle(px.tile + 1, py.tile + 1), px.eighths),
      py.eighths);
}

int PlainBackground::excess(int x, int y) const {
  return value(x, y) - at(x, y);
}

}  // namespace dottrack::image::test
