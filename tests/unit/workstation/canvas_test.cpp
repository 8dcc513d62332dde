#include "app/workstation/canvas.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <limits>

#include "app/workstation/bitmap_font.h"
#include "tests/support/disc_scene.h"
#include "tests/unit/workstation/colours.h"

namespace dottrack::workstation {
namespace {

constexpr Colour kRed{255, 0, 0};
constexpr Colour kBlack{0, 0, 0};

TEST(Canvas, IsACopyOfAGreyImage) {
  const test::GreyImage noise = test::noise_image(7, 5, 3);
  const Canvas canvas(noise.view());
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      const std::uint8_t grey = noise.view().at(x, y);
      EXPECT_EQ(canvas.at(x, y), (Colour{grey, grey, grey}));
    }
  }
}

TEST(Canvas, ALineHasNoGaps) {
  Canvas canvas(20, 20);
  canvas.line({2, 3}, {17, 9}, kRed, 1);
  EXPECT_EQ(count(canvas, kRed), 16);
  EXPECT_EQ(canvas.at(2, 3), kRed);
  EXPECT_EQ(canvas.at(17, 9), kRed);
}

TEST(Canvas, AWideLineIsWide) {
  Canvas canvas(20, 20);
  canvas.line({2, 10}, {17, 10}, kRed, 3);
  for (int y = 9; y <= 11; ++y) EXPECT_EQ(canvas.at(10, y), kRed);
  EXPECT_EQ(canvas.at(10, 8), kBlack);
  EXPECT_EQ(canvas.at(10, 12), kBlack);
}

TEST(Canvas, NothingIsDrawnOutside) {
  Canvas canvas(8, 8);
  canvas.line({-100, -5}, {100, -5}, kRed, 1);
  canvas.line({std::numeric_limits<double>::quiet_NaN(), 0}, {5, 5}, kRed, 1);
  canvas.box({-20, -20}, {30, 30}, kRed, 1);
  canvas.ellipse({1e9, 1e9}, 4, 3, 0.2, kRed, 1);
  canvas.text(-100, -100, "OUT", kRed, 2);
  canvas.shade(-5, -5, 3, 3);
  EXPECT_EQ(count(canvas, kRed), 0);
}

TEST(Canvas, ABoxIsFourLines) {
  Canvas canvas(20, 20);
  canvas.box({3, 4}, {10, 12}, kRed, 1);
  EXPECT_EQ(count(canvas, kRed), 2 * 8 + 2 * 9 - 4);
  EXPECT_EQ(canvas.at(6, 8), kBlack);
}

TEST(Canvas, AnEllipseReachesAsFarAsItsAxes) {
  Canvas canvas(60, 60);
  const double angle_rad = 0.5;
  canvas.ellipse({30, 30}, 20, 8, angle_rad, kRed, 1);
  const Eigen::Vector2d centre(30, 30);
  const Eigen::Vector2d major(std::cos(angle_rad), std::sin(angle_rad));
  const Eigen::Vector2d minor(-major.y(), major.x());
  EXPECT_TRUE(near(canvas, centre + 20 * major, kRed, 1));
  EXPECT_TRUE(near(canvas, centre - 8 * minor, kRed, 1));
  EXPECT_FALSE(near(canvas, centre + 20 * minor, kRed, 3));
  EXPECT_FALSE(near(canvas, centre, kRed, 3));
}

TEST(Canvas, TextIsSixColumnsALetterAndSmallLettersAreCapitals) {
  Canvas capitals(40, 10);
  Canvas small(40, 10);
  EXPECT_EQ(capitals.text(1, 1, "AX-9.", kRed, 1), 30);
  small.text(1, 1, "ax-9.", kRed, 1);
  EXPECT_GT(count(capitals, kRed), 30);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 40; ++x) EXPECT_EQ(capitals.at(x, y), small.at(x, y));
  }
}

TEST(BitmapFont, KnowsEverySignOfALegendAndNoTwoAreAlike) {
  const std::string_view signs = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ.-:_+=/(),";
  for (const char sign : signs) {
    EXPECT_NE(glyph_of(sign).rows, glyph_of(' ').rows) << sign;
    for (const char other : signs) {
      if (other == sign) continue;
      EXPECT_NE(glyph_of(sign).rows, glyph_of(other).rows) << sign << other;
    }
  }
}

TEST(Canvas, ThePngHoldsItsPixels) {
  Canvas canvas(test::noise_image(33, 21, 5).view());
  canvas.line({0, 0}, {32, 20}, kRed, 2);
  const Result<std::string> png = canvas.png();
  ASSERT_TRUE(png) << png.error().message;
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&image, png->data(), png->size()), 0);
  ASSERT_EQ(image.width, 33U);
  ASSERT_EQ(image.height, 21U);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
  ASSERT_NE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr), 0);
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 33; ++x) {
      const std::size_t i = 3 * static_cast<std::size_t>(y * 33 + x);
      ASSERT_EQ(canvas.at(x, y), (Colour{rgb[i], rgb[i + 1], rgb[i + 2]}));
    }
  }
}

}  // namespace
}  // namespace dottrack::workstation
