#include "tests/unit/image/pictures.h"

#include <algorithm>
#include <cmath>

namespace dottrack::image::test {

int integer(Random& random, int lo, int hi) {
  return std::uniform_int_distribution<int>(lo, hi)(random);
}

double real(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

Picture::Picture(int width_px, int height_px, int padding_bytes)
    : width_px_(width_px), height_px_(height_px), stride_(width_px + padding_bytes) {
  bytes_.assign(index(width_px - 1, height_px - 1) + 1, 200);  // the padding is in many a band
  fill(0);
}

void Picture::fill(std::uint8_t grey) {
  for (int y = 0; y < height_px_; ++y) {
    for (int x = 0; x < width_px_; ++x) at(x, y) = grey;
  }
}

ImageView Picture::view() const {
  return {bytes_.data(), width_px_, height_px_, stride_};
}

void add_noise(Picture& picture, Random& random, int lo, int hi) {
  for (int y = 0; y < picture.height_px(); ++y) {
    for (int x = 0; x < picture.width_px(); ++x) {
      picture.at(x, y) = static_cast<std::uint8_t>(integer(random, lo, hi));
    }
  }
}

void add_speckle(Picture& picture, Random& random, double probability) {
  std::bernoulli_distribution set(probability);
  for (int y = 0; y < picture.height_px(); ++y) {
    for (int x = 0; x < picture.width_px(); ++x) {
      if (set(random)) picture.at(x, y) = static_cast<std::uint8_t>(integer(random, 128, 255));
    }
  }
}

void add_ellipse(Picture& picture, double x, double y, double semi_major, double semi_minor,
                 double angle_rad, std::uint8_t grey) {
  for (int j = 0; j < picture.height_px(); ++j) {
    for (int i = 0; i < picture.width_px(); ++i) {
      const double along = std::cos(angle_rad) * (i - x) + std::sin(angle_rad) * (j - y);
      const double across = std::cos(angle_rad) * (j - y) - std::sin(angle_rad) * (i - x);
      if (std::hypot(along / semi_major, across / semi_minor) <= 1.0) picture.at(i, j) = grey;
    }
  }
}

void add_blobs(Picture& picture, Random& random, int count) {
  for (int k = 0; k < count; ++k) {
    add_ellipse(picture, real(random, 0.0, picture.width_px()),
                real(random, 0.0, picture.height_px()), real(random, 1.0, 9.0),
                real(random, 0.7, 4.0), real(random, -3.0, 3.0),
                static_cast<std::uint8_t>(integer(random, 128, 255)));
  }
}

void add_snakes(Picture& picture, Random& random, int count) {
  constexpr int kDx[] = {1, 0, -1, 0};
  constexpr int kDy[] = {0, 1, 0, -1};
  for (int k = 0; k < count; ++k) {
    int x = integer(random, 0, picture.width_px() - 1);
    int y = integer(random, 0, picture.height_px() - 1);
    for (int step = 0; step < 200; ++step) {
      picture.at(x, y) = static_cast<std::uint8_t>(integer(random, 128, 255));
      const int turn = integer(random, 0, 3);
      x = std::clamp(x + kDx[turn], 0, picture.width_px() - 1);
      y = std::clamp(y + kDy[turn], 0, picture.height_px() - 1);
    }
  }
}

// A path one pixel wide with one pixel between its turns, from the corner inwards: in most rows its
// runs belong together only through rows that come later.
void add_spiral(Picture& picture, std::uint8_t grey) {
  int left = 0;
  int top = 0;
  int right = picture.width_px() - 1;
  int bottom = picture.height_px() - 1;
  while (left <= right && top <= bottom) {
    for (int x = std::max(left - 2, 0); x <= right; ++x) picture.at(x, top) = grey;
    for (int y = top; y <= bottom; ++y) picture.at(right, y) = grey;
    for (int x = left; x <= right; ++x) picture.at(x, bottom) = grey;
    for (int y = std::min(top + 2, bottom); y <= bottom; ++y) picture.at(left, y) = grey;
    left += 2;
    top += 2;
    right -= 2;
    bottom -= 2;
  }
}

Picture random_picture(Random& random, int max_px) {
  const bool thin = integer(random, 0, 9) == 0;
  Picture picture(integer(random, 1, thin ? 2 : max_px), integer(random, 1, max_px),
                  integer(random, 0, 1) * integer(random, 0, 70));
  add_noise(picture, random, 0, 127);
  switch (integer(random, 0, 6)) {
    case 0:
      add_noise(picture, random, 0, 255);
      break;
    case 1:
      add_speckle(picture, random, real(random, 0.0, 0.1));
      break;
    case 2:
      add_speckle(picture, random, real(random, 0.3, 0.9));
      break;
    case 3:
      add_snakes(picture, random, integer(random, 1, 12));
      break;
    case 4:
      add_spiral(picture, 200);
      break;
    default:
      add_speckle(picture, random, 0.01);
      add_blobs(picture, random, integer(random, 1, 30));
      break;
  }
  return picture;
}

}  // namespace dottrack::image::test
