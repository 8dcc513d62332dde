#include "app/workstation/canvas.h"

#include <png.h>

#include <array>
#include <cmath>
#include <numbers>

#include "app/workstation/bitmap_font.h"
#include "app/workstation/clip_line.h"

namespace dottrack::workstation {
namespace {

std::size_t pixels_of(int width_px, int height_px) {
  return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
}

int rounded(double value) {
  return static_cast<int>(std::lround(value));
}

}  // namespace

Canvas::Canvas(int width_px, int height_px)
    : width_px_(width_px), height_px_(height_px), rgb_(3 * pixels_of(width_px, height_px)) {}

Canvas::Canvas(const ImageView& grey) : Canvas(grey.width_px, grey.height_px) {
  for (int y = 0; y < height_px_; ++y) {
    for (int x = 0; x < width_px_; ++x) {
      const std::uint8_t value = grey.at(x, y);
      set(x, y, {value, value, value});
    }
  }
}

Colour Canvas::at(int x, int y) const {
  const std::size_t i = 3 * (pixels_of(width_px_, y) + static_cast<std::size_t>(x));
  return {rgb_[i], rgb_[i + 1], rgb_[i + 2]};
}

void Canvas::set(int x, int y, Colour colour) {
  if (x < 0 || y < 0 || x >= width_px_ || y >= height_px_) return;
  const std::size_t i = 3 * (pixels_of(width_px_, y) + static_cast<std::size_t>(x));
  rgb_[i] = colour.red;
  rgb_[i + 1] = colour.green;
  rgb_[i + 2] = colour.blue;
}

void Canvas::square(int x, int y, int size_px, Colour colour) {
  for (int j = 0; j < size_px; ++j) {
    for (int i = 0; i < size_px; ++i) set(x + i, y + j, colour);
  }
}

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Colour colour,
                  int line_px) {
  Eigen::Vector2d a = from;
  Eigen::Vector2d b = to;
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(line_px);
  if (!clip_line(-margin, Eigen::Vector2d(width_px_, height_px_) + margin, a, b)) return;
  const int steps = std::max(1, rounded((b - a).cwiseAbs().maxCoeff()));
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d p = a + (b - a) * (static_cast<double>(i) / steps);
    square(rounded(p.x()) - line_px / 2, rounded(p.y()) - line_px / 2, line_px, colour);
  }
}

void Canvas::polyline(std::span<const Eigen::Vector2d> points, Colour colour, int line_px) {
  for (std::size_t i = 1; i < points.size(); ++i) line(points[i - 1], points[i], colour, line_px);
}

void Canvas::box(const Eigen::Vector2d& min, const Eigen::Vector2d& max, Colour colour,
                 int line_px) {
  const std::array<Eigen::Vector2d, 5> corners = {min, Eigen::Vector2d(max.x(), min.y()), max,
                                                  Eigen::Vector2d(min.x(), max.y()), min};
  polyline(corners, colour, line_px);
}

void Canvas::ellipse(const Eigen::Vector2d& centre, double semi_major_px, double semi_minor_px,
                     double angle_rad, Colour colour, int line_px) {
  constexpr int kSides = 48;
  const Eigen::Vector2d major(std::cos(angle_rad), std::sin(angle_rad));
  const Eigen::Vector2d minor(-major.y(), major.x());
  std::array<Eigen::Vector2d, kSides + 1> points;
  for (int i = 0; i <= kSides; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kSides;
    points[static_cast<std::size_t>(i)] =
        centre + semi_major_px * std::cos(turn) * major + semi_minor_px * std::sin(turn) * minor;
  }
  polyline(points, colour, line_px);
}

void Canvas::shade(int x, int y, int width_px, int height_px) {
  for (int j = std::max(0, y); j < std::min(height_px_, y + height_px); ++j) {
    for (int i = std::max(0, x); i < std::min(width_px_, x + width_px); ++i) {
      const Colour c = at(i, j);
      const auto darker = [](std::uint8_t value) { return static_cast<std::uint8_t>(value / 4); };
      set(i, j, {darker(c.red), darker(c.green), darker(c.blue)});
    }
  }
}

int Canvas::text(int x, int y, std::string_view words, Colour colour, int scale_px) {
  const int start = x;
  for (const char letter : words) {
    const Glyph& glyph = glyph_of(letter);
    for (int row = 0; row < kGlyphRows; ++row) {
      for (int column = 0; column < kGlyphColumns; ++column) {
        if (!glyph.dot(row, column)) continue;
        square(x + column * scale_px, y + row * scale_px, scale_px, colour);
      }
    }
    x += (kGlyphColumns + 1) * scale_px;
  }
  return x - start;
}

Result<std::string> Canvas::png() const {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_px_);
  image.height = static_cast<png_uint_32>(height_px_);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb_.data(), 0, nullptr) == 0) {
    return fail(std::string("cannot write a PNG picture (") + image.message + ")");
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace dottrack::workstation
