#pragma once
// Pictures that are hard on identify: noise, snakes, spirals, blobs, at any size and stride.

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "hal/base/image_view.h"

namespace dottrack::image::test {

using Random = std::mt19937;

int integer(Random& random, int lo, int hi);  // both ends included
double real(Random& random, double lo, double hi);

// The memory ends with the last pixel of the last row, so that a sanitizer sees a read behind it.
class Picture {
 public:
  Picture(int width_px, int height_px, int padding_bytes = 0);

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  std::uint8_t& at(int x, int y) { return bytes_[index(x, y)]; }
  std::uint8_t at(int x, int y) const { return bytes_[index(x, y)]; }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_px_ && y < height_px_; }
  void fill(std::uint8_t grey);
  ImageView view() const;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_) +
           static_cast<std::size_t>(x);
  }

  int width_px_;
  int height_px_;
  int stride_;
  std::vector<std::uint8_t> bytes_;
};

void add_noise(Picture& picture, Random& random, int lo, int hi);
// Each pixel is set with this probability, to a grey of 128 or more.
void add_speckle(Picture& picture, Random& random, double probability);
void add_blobs(Picture& picture, Random& random, int count);
void add_snakes(Picture& picture, Random& random, int count);
void add_spiral(Picture& picture, std::uint8_t grey);
// Every pixel whose centre lies in the ellipse.
void add_ellipse(Picture& picture, double x, double y, double semi_major, double semi_minor,
                 double angle_rad, std::uint8_t grey);

// One of the kinds above, of a random size up to max_px and a random stride.
Picture random_picture(Random& random, int max_px);

}  // namespace dottrack::image::test
