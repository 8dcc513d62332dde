// The background of tiles against means that are summed up pixel by pixel.

#include "app/core/image/local_background.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "app/core/image/bitmap.h"
#include "tests/unit/image/pictures.h"
#include "tests/unit/image/plain_background.h"
#include "tests/unit/image/plain_identify.h"

namespace dottrack::image::test {
namespace {

class LocalBackgroundTest : public testing::Test {
 protected:
  // Checks every pixel of the window, a few rows at a time.
  void check(const Picture& picture, const Window& window, const Band& band) {
    const int height = window.y_max - window.y_min + 1;
    bitmap_->reshape(window.x_max - window.x_min + 1, height);
    background_->start(picture.view(), window, band);
    int filled = 0;
    for (int y = 0; y < height; y += 7) {
      const int y_end = std::min(y + 7, height);
      filled = background_->fill(y_end, *bitmap_);
      ASSERT_GE(filled, y_end);
    }
    ASSERT_EQ(filled, height);
    const PlainBackground plain(picture, band);
    for (int y = window.y_min; y <= window.y_max && !HasFatalFailure(); ++y) {
      for (int x = window.x_min; x <= window.x_max; ++x) check(picture, window, band, plain, x, y);
    }
  }

  void check(const Picture& picture, const Window& window, const Band& band,
             const PlainBackground& plain, int x, int y) {
    const int above = plain.excess(x, y) - band.min_contrast_dn;
    const int i = x - window.x_min;
    const int j = y - window.y_min;
    const bool kept = bitmap_->at(i, j);
    ASSERT_EQ(kept, above >= 0 && picture.at(x, y) >= band.intensity_min_dn &&
                        picture.at(x, y) <= band.intensity_max_dn)
        << x << ' ' << y;
    ++pixels_;
    if (!kept) return;
    const bool bright = band.polarity == core::Polarity::bright;
    const int end = bright ? picture.at(x, y) - band.intensity_min_dn
                           : band.intensity_max_dn - picture.at(x, y);
    ASSERT_EQ(std::abs(picture.at(x, y) - background_->thresholds().row(j)[i]),
              std::min(above, end) + 1);
    ++kept_;
  }

  Random random_{4};
  std::unique_ptr<Bitmap> bitmap_ = std::make_unique<Bitmap>();
  std::unique_ptr<LocalBackground> background_ = std::make_unique<LocalBackground>();
  int pixels_ = 0;
  int kept_ = 0;
};

core::Polarity polarity_of(int i) {
  return i % 2 == 0 ? core::Polarity::bright : core::Polarity::dark;
}

TEST_F(LocalBackgroundTest, IsThatOfTheTilesForAnyBoxAndPolarity) {
  for (int i = 0; i < 400 && !HasFailure(); ++i) {
    const Picture picture = random_picture(random_, 140);
    check(picture, whole(picture),
          {.min_contrast_dn = integer(random_, 1, 60),
           .background_px = 2 * integer(random_, 1, 70) + 1,
           .polarity = polarity_of(i)});
  }
  EXPECT_GT(pixels_, 500000);
  EXPECT_GT(kept_, 50000);
}

TEST_F(LocalBackgroundTest, AContrastRelativeToItHolds) {
  for (int i = 0; i < 400 && !HasFailure(); ++i) {
    const Picture picture = random_picture(random_, 140);
    check(picture, whole(picture),
          {.min_contrast_dn = integer(random_, 1, 30),
           .background_px = 2 * integer(random_, 1, 30) + 1,
           .polarity = polarity_of(i),
           .min_contrast_256ths = integer(random_, 1, i % 10 == 0 ? 1024 : 150)});
  }
  EXPECT_GT(pixels_, 500000);
  EXPECT_GT(kept_, 20000);
}

TEST_F(LocalBackgroundTest, TheBandHoldsToo) {
  for (int i = 0; i < 200 && !HasFailure(); ++i) {
    const Picture picture = random_picture(random_, 140);
    const int least = integer(random_, 0, 200);
    check(picture, whole(picture),
          {.intensity_min_dn = least,
           .intensity_max_dn = integer(random_, 0, 2) == 0 ? 255 : integer(random_, least, 255),
           .min_contrast_dn = integer(random_, 1, 60),
           .polarity = polarity_of(i)});
  }
  EXPECT_GT(pixels_, 200000);
  EXPECT_GT(kept_, 5000);
}

TEST_F(LocalBackgroundTest, IsTheSameInAWindow) {
  for (int i = 0; i < 600 && !HasFailure(); ++i) {
    const Picture picture = random_picture(random_, 200);
    const int x = integer(random_, 0, picture.width_px() - 1);
    const int y = integer(random_, 0, picture.height_px() - 1);
    const Window window{x, y, integer(random_, x, picture.width_px() - 1),
                        integer(random_, y, picture.height_px() - 1)};
    check(picture, window,
          {.min_contrast_dn = integer(random_, 1, 40),
           .background_px = 2 * integer(random_, 1, 30) + 1,
           .polarity = polarity_of(i)});
  }
  EXPECT_GT(pixels_, 300000);
  EXPECT_GT(kept_, 30000);
}

// Column and box sums are at their largest.
TEST_F(LocalBackgroundTest, TheLargestBoxOfTheBrightestPixelsDoesNotOverflow) {
  Picture picture(core::kMaxImageWidth, core::kMaxImageHeight);
  picture.fill(255);
  for (int i = 0; i < 4000; ++i) {
    picture.at(integer(random_, 1200, 2047), integer(random_, 1700, 2047)) = 0;
  }
  for (const int i : {0, 1}) {
    check(picture, {1400, 1990, 2047, 2047},
          {.min_contrast_dn = 1, .background_px = 255, .polarity = polarity_of(i)});
  }
  EXPECT_EQ(pixels_, 2 * 648 * 58);
  EXPECT_GT(kept_, 10000);
}

TEST_F(LocalBackgroundTest, LargeImages) {
  for (const auto& [width, height] : {std::pair(1280, 1021), std::pair(2048, 203)}) {
    Picture picture(width, height);
    add_noise(picture, random_, 40, 80);
    add_blobs(picture, random_, 100);
    check(picture, whole(picture), {.min_contrast_dn = 30, .background_px = 21});
  }
  EXPECT_GT(pixels_, 1700000);
  EXPECT_GT(kept_, 5000);
}

TEST_F(LocalBackgroundTest, NoPixelExceedsAFlatBackgroundAndNoContrastIsTooLarge) {
  Picture picture(100, 50);
  for (const int grey : {0, 1, 77, 128, 254, 255}) {
    picture.fill(static_cast<std::uint8_t>(grey));
    check(picture, whole(picture), {.min_contrast_dn = 1, .background_px = 21});
    check(picture, whole(picture),
          {.min_contrast_dn = 1, .background_px = 255, .polarity = core::Polarity::dark});
  }
  EXPECT_EQ(kept_, 0);
  picture.fill(0);
  picture.at(50, 25) = 255;
  check(picture, whole(picture), {.min_contrast_dn = 255, .background_px = 3});
  check(picture, whole(picture), {.min_contrast_dn = 300, .background_px = 21});
  EXPECT_EQ(kept_, 0);
}

// What rounding does: an interpolation that favours neither side.
TEST_F(LocalBackgroundTest, RoundsByLittleAndNeitherUpNorDown) {
  double sum = 0.0;
  int pixels = 0;
  for (int i = 0; i < 60; ++i) {
    const Picture picture = random_picture(random_, 200);
    const PlainBackground plain(
        picture, {.background_px = 2 * integer(random_, 1, 40) + 1, .polarity = polarity_of(i)});
    for (int y = 0; y < picture.height_px(); ++y) {
      for (int x = 0; x < picture.width_px(); ++x) {
        const double difference = plain.at(x, y) - plain.exact(x, y);
        ASSERT_LE(std::abs(difference), 1.625);  // of the mean 0.5, of averages 1.125
        sum += difference;
        ++pixels;
      }
    }
  }
  EXPECT_GT(pixels, 150000);
  EXPECT_LT(std::abs(sum / pixels), 0.1);
}

}  // namespace
}  // namespace dottrack::image::test
