// The sliding box means against means that are summed up pixel by pixel.

#include "app/core/image/local_background.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "app/core/image/band_bitmap.h"
#include "tests/unit/image/pictures.h"
#include "tests/unit/image/plain_identify.h"

namespace dottrack::image::test {
namespace {

class LocalBackgroundTest : public testing::Test {
 protected:
  // Checks every pixel of the window.
  void check(const Picture& picture, const Window& window, const Band& band) {
    const int height = window.y_max - window.y_min + 1;
    bitmap_->reshape(window.x_max - window.x_min + 1, height);
    fill_band_rows(picture.view(), window, band, 0, height, *bitmap_);
    background_->keep_contrast(picture.view(), window, band, *bitmap_);
    const ImageView excess = background_->excess();
    const int sign = band.polarity == core::Polarity::bright ? 1 : -1;
    for (int y = window.y_min; y <= window.y_max; ++y) {
      for (int x = window.x_min; x <= window.x_max; ++x) {
        const PlainBackground b = plain_background(picture, x, y, band.background_px);
        const int above =
            sign * (picture.at(x, y) * b.count - b.sum) - band.min_contrast_dn * b.count;
        const bool kept = bitmap_->at(x - window.x_min, y - window.y_min);
        ASSERT_EQ(kept, above >= 0) << x << ' ' << y;
        ++pixels_;
        if (!kept) continue;
        const double exact = 1.0 + static_cast<double>(above) / b.count;
        const int weight = excess.at(x - window.x_min, y - window.y_min);
        ASSERT_GE(weight, 1);
        ASSERT_NEAR(weight, exact, 0.501) << x << ' ' << y;  // rounded
        ++kept_;
      }
    }
  }

  Random random_{4};
  std::unique_ptr<Bitmap> bitmap_ = std::make_unique<Bitmap>();
  std::unique_ptr<LocalBackground> background_ = std::make_unique<LocalBackground>();
  int pixels_ = 0;
  int kept_ = 0;
};

TEST_F(LocalBackgroundTest, IsExactForAnyBoxAndPolarity) {
  for (int i = 0; i < 250 && !HasFailure(); ++i) {
    const Picture picture = random_picture(random_, 90);
    const Band band{.min_contrast_dn = integer(random_, 1, 60),
                    .background_px = 2 * integer(random_, 1, 20) + 1,
                    .polarity = i % 2 == 0 ? core::Polarity::bright : core::Polarity::dark};
    check(picture, whole(picture), band);
  }
  EXPECT_GT(pixels_, 200000);
  EXPECT_GT(kept_, 20000);
}

TEST_F(LocalBackgroundTest, IsExactInAWindow) {
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    const Picture picture = random_picture(random_, 150);
    const int x = integer(random_, 0, picture.width_px() - 1);
    const int y = integer(random_, 0, picture.height_px() - 1);
    const Window window{x, y, integer(random_, x, picture.width_px() - 1),
                        integer(random_, y, picture.height_px() - 1)};
    check(picture, window, {.min_contrast_dn = integer(random_, 1, 40), .background_px = 21});
  }
  EXPECT_GT(pixels_, 80000);
  EXPECT_GT(kept_, 8000);
}

TEST_F(LocalBackgroundTest, IsExactForTheLargestBoxOfTheBrightestPixels) {
  Picture picture(300, 280);
  picture.fill(255);
  for (int i = 0; i < 400; ++i) picture.at(integer(random_, 0, 299), integer(random_, 0, 279)) = 0;
  for (const auto polarity : {core::Polarity::bright, core::Polarity::dark}) {
    check(picture, {140, 130, 170, 150},
          {.min_contrast_dn = 1, .background_px = 255, .polarity = polarity});
  }
  EXPECT_EQ(pixels_, 2 * 31 * 21);
  EXPECT_GT(kept_, 0);
}

TEST_F(LocalBackgroundTest, NoPixelExceedsAFlatBackgroundAndNoContrastIsTooLarge) {
  Picture picture(100, 50);
  picture.fill(255);
  check(picture, whole(picture), {.min_contrast_dn = 1, .background_px = 21});
  EXPECT_EQ(kept_, 0);
  picture.fill(0);
  picture.at(50, 25) = 255;
  check(picture, whole(picture), {.min_contrast_dn = 255, .background_px = 21});
  check(picture, whole(picture), {.min_contrast_dn = 300, .background_px = 21});
  EXPECT_EQ(kept_, 0);
}

}  // namespace
}  // namespace dottrack::image::test
