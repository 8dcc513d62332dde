// Identify against the plain flood fill, on random pictures, bands, windows and gates.

#include <gtest/gtest.h>

#include <memory>

#include "app/core/image/identify.h"
#include "tests/unit/image/pictures.h"
#include "tests/unit/image/plain_identify.h"

namespace dottrack::image::test {
namespace {

class IdentifyReference : public testing::Test {
 protected:
  void compare(const Picture& picture, const Window& window, const Band& band,
               const RegionGate& gate) {
    const IdentifyCounts counts =
        identifier_.identify(picture.view(), window, band, gate, *regions_);
    expect_equal(plain_identify(picture, window, band, gate), counts, *regions_, comparisons_);
  }

  Window random_window(const Picture& picture) {
    const int x = integer(random_, -5, picture.width_px() + 3);
    const int y = integer(random_, -5, picture.height_px() + 3);
    return {x, y, x + integer(random_, 0, 100), y + integer(random_, 0, 40)};
  }

  // Gates off the values that small regions have: no axis of a few pixels is within rounding of
  // them.
  RegionGate random_gate() {
    RegionGate gate;
    if (integer(random_, 0, 1) == 0) return gate;
    gate.semi_major_min_px = real(random_, 0.0, 3.0);
    gate.semi_major_max_px = gate.semi_major_min_px + real(random_, 0.0, 20.0);
    gate.min_axis_ratio = real(random_, 0.0, 0.7);
    gate.min_fill = real(random_, 0.0, 0.95);
    gate.min_core_contrast_dn = real(random_, -100.0, 20.0);
    gate.min_area_px = integer(random_, 0, 20);
    gate.max_box_misfit_px = real(random_, 0.1, 4.0);
    gate.max_box_misfit_part = real(random_, 0.0, 0.3);
    gate.max_lack_px = real(random_, 0.1, 2.0);
    return gate;
  }

  core::Polarity random_polarity() {
    return integer(random_, 0, 1) == 0 ? core::Polarity::bright : core::Polarity::dark;
  }

  Band random_band() {
    Band band;
    band.polarity = random_polarity();
    band.intensity_min_dn = integer(random_, 0, 200);
    band.intensity_max_dn = integer(random_, band.intensity_min_dn, 255);
    return band;
  }

  Random random_{20260};
  Identifier identifier_;
  std::unique_ptr<Regions> regions_ = std::make_unique<Regions>();
  int comparisons_ = 0;
};

TEST_F(IdentifyReference, AbsoluteBandOnWholePictures) {
  for (int i = 0; i < 1500 && !HasFailure(); ++i) {
    const Picture picture = random_picture(random_, 200);
    Band band;
    band.intensity_min_dn = integer(random_, 0, 3) == 0 ? integer(random_, 0, 255) : 128;
    compare(picture, whole(picture), band, random_gate());
  }
  EXPECT_GT(comparisons_, 50000);
}

TEST_F(IdentifyReference, BandsOfEitherPolarity) {
  for (int i = 0; i < 600 && !HasFailure(); ++i) {
    const Picture picture = random_picture(random_, 150);
    compare(picture, whole(picture), random_band(), random_gate());
  }
  EXPECT_GT(comparisons_, 20000);
}

TEST_F(IdentifyReference, Windows) {
  for (int i = 0; i < 6000 && !HasFailure(); ++i) {
    const Picture picture = random_picture(random_, 150);
    Band band;
    band.intensity_min_dn = 128;
    compare(picture, random_window(picture), band, random_gate());
  }
  EXPECT_GT(comparisons_, 10000);
}

TEST_F(IdentifyReference, LocalBackgroundOnWholePictures) {
  for (int i = 0; i < 200 && !HasFailure(); ++i) {
    const Picture picture = random_picture(random_, 90);
    Band band;
    band.polarity = random_polarity();
    band.min_contrast_dn = integer(random_, 1, 60);
    band.background_px = 2 * integer(random_, 1, 15) + 1;
    compare(picture, whole(picture), band, random_gate());
  }
  EXPECT_GT(comparisons_, 5000);
}

TEST_F(IdentifyReference, LocalBackgroundInWindowsAndBands) {
  for (int i = 0; i < 900 && !HasFailure(); ++i) {
    const Picture picture = random_picture(random_, 120);
    Band band = random_band();
    band.min_contrast_dn = integer(random_, 1, 40);
    band.min_contrast_256ths = i % 2 == 0 ? 0 : integer(random_, 1, 200);
    band.background_px = 2 * integer(random_, 1, 12) + 1;
    compare(picture, random_window(picture), band, random_gate());
  }
  EXPECT_GT(comparisons_, 1000);
}

TEST_F(IdentifyReference, LocalBackgroundLargerThanThePicture) {
  for (int i = 0; i < 50 && !HasFailure(); ++i) {
    const Picture picture = random_picture(random_, 40);
    Band band;
    band.polarity = random_polarity();
    band.min_contrast_dn = integer(random_, 1, 30);
    band.background_px = 255;
    compare(picture, whole(picture), band, {});
  }
  EXPECT_GT(comparisons_, 300);
}

}  // namespace
}  // namespace dottrack::image::test
