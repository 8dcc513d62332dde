#pragma once
// A colour picture to draw on.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/image_view.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

// Coordinates are pixels as everywhere: (0, 0) is the centre of the first. What lies outside is not
// drawn; a coordinate that is not finite draws nothing.
class Canvas {
 public:
  Canvas(int width_px, int height_px);     // black
  explicit Canvas(const ImageView& grey);  // a copy

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  Colour at(int x, int y) const;

  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Colour colour, int line_px);
  void polyline(std::span<const Eigen::Vector2d> points, Colour colour, int line_px);
  void box(const Eigen::Vector2d& min, const Eigen::Vector2d& max, Colour colour, int line_px);
  void ellipse(const Eigen::Vector2d& centre, double semi_major_px, double semi_minor_px,
               double angle_rad, Colour colour, int line_px);
  // Makes a rectangle darker, so that text on it can be read.
  void shade(int x, int y, int width_px, int height_px);
  // Capital letters, digits and some signs, each 5 x 7 squares of scale_px; (x, y) is the upper
  // left corner. Returns the width in pixels.
  int text(int x, int y, std::string_view words, Colour colour, int scale_px);

  // As the bytes of a PNG file.
  Result<std::string> png() const;

 private:
  void set(int x, int y, Colour colour);
  void square(int x, int y, int size_px, Colour colour);

  int width_px_;
  int height_px_;
  std::vector<std::uint8_t> rgb_;
};

}  // namespace dottrack::workstation
