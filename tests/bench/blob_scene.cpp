#include "tests/bench/blob_scene.h"

#include <algorithm>
#include <cmath>

namespace dottrack::bench {

namespace {

int integer(std::mt19937& random, int lo, int hi) {
  return std::uniform_int_distribution<int>(lo, hi)(random);
}

double real(std::mt19937& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

void blob(Picture& picture, double radius_min, double radius_max, std::mt19937& random) {
  const double radius = real(random, radius_min, radius_max);
  picture.ellipse(real(random, 10.0, kSetWidth - 10.0), real(random, 10.0, kSetHeight - 10.0),
                  radius, radius * real(random, 0.7, 1.0), random);
}

}  // namespace

Picture::Picture() : pixels_(static_cast<std::size_t>(kSetWidth * kSetHeight)) {}

void Picture::speck(int x, int y, std::mt19937& random) {
  if (x < 0 || y < 0 || x >= kSetWidth || y >= kSetHeight) return;
  pixels_[static_cast<std::size_t>(y * kSetWidth + x)] =
      static_cast<std::uint8_t>(integer(random, 160, 255));
}

void Picture::ellipse(double x, double y, double a, double b, std::mt19937& random) {
  for (int j = static_cast<int>(y - b); j <= static_cast<int>(y + b) + 1; ++j) {
    for (int i = static_cast<int>(x - a); i <= static_cast<int>(x + a) + 1; ++i) {
      if (std::hypot((i - x) / a, (j - y) / b) <= 1.0) speck(i, j, random);
    }
  }
}

void Picture::darken(std::mt19937& random) {
  for (auto& pixel : pixels_) pixel = static_cast<std::uint8_t>(integer(random, 20, 70));
}

double Picture::part_in_band() const {
  const auto in_band = std::count_if(pixels_.begin(), pixels_.end(),
                                     [](std::uint8_t pixel) { return pixel >= kBandMin; });
  return static_cast<double>(in_band) / static_cast<double>(pixels_.size());
}

ImageView Picture::view() const {
  return {pixels_.data(), kSetWidth, kSetHeight, kSetWidth};
}

void paint_clutter(Picture& picture, std::mt19937& random) {
  for (int k = 0; k < 3; ++k) {
    picture.ellipse(real(random, 150.0, kSetWidth - 150.0), real(random, 20.0, kSetHeight - 20.0),
                    140.0, 14.6, random);
  }
  for (int k = 0; k < 300; ++k) blob(picture, 2.0, 3.9, random);
  for (int k = 0; k < 1160; ++k) {
    picture.speck(integer(random, 0, kSetWidth - 1), integer(random, 0, kSetHeight - 1), random);
  }
}

PictureSet sparse_set() {
  std::mt19937 random(100);
  PictureSet set;
  for (Picture& picture : set) {
    picture.darken(random);
    for (int k = 0; k < 100; ++k) blob(picture, 2.4, 4.4, random);
  }
  return set;
}

PictureSet heavy_set() {
  std::mt19937 random(200);
  PictureSet set;
  for (Picture& picture : set) {
    picture.darken(random);
    paint_clutter(picture, random);
  }
  return set;
}

}  // namespace dottrack::bench
