#pragma once
// Pictures with a known amount of work in them for identify: blobs, speckle, large bright areas.

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "hal/base/image_view.h"

namespace dottrack::bench {

inline constexpr std::size_t kSetImages = 12;
inline constexpr int kSetWidth = 640;
inline constexpr int kSetHeight = 480;
inline constexpr int kBandMin = 128;  // pixels from here to 255 are in band

class Picture {
 public:
  Picture();

  // Every pixel whose centre lies in the ellipse becomes bright.
  void ellipse(double x, double y, double a, double b, std::mt19937& random);
  void speck(int x, int y, std::mt19937& random);
  void darken(std::mt19937& random);  // all of it, to a noisy ground out of band

  double part_in_band() const;
  ImageView view() const;

 private:
  std::vector<std::uint8_t> pixels_;
};

using PictureSet = std::array<Picture, kSetImages>;

// 100 blobs an image, 1 % of the pixels in band.
PictureSet sparse_set();
// 300 blobs, 1000 specks and three large areas: 8.6 % of the pixels in band, about 1300 components
// and 2600 runs an image, specks counted.
PictureSet heavy_set();

// What makes the heavy set heavy, over whatever the picture shows.
void paint_clutter(Picture& picture, std::mt19937& random);

}  // namespace dottrack::bench
