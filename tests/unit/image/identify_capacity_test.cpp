// What identify does when a picture holds more than it can.

#include <gtest/gtest.h>

#include <memory>

#include "app/core/image/identify.h"
#include "tests/unit/image/pictures.h"
#include "tests/unit/image/plain_identify.h"

namespace dottrack::image::test {
namespace {

constexpr Band kBright{.intensity_min_dn = 128};

class IdentifyCapacity : public testing::Test {
 protected:
  IdentifyCounts identify(const Picture& picture) {
    return identifier_.identify(picture.view(), kBright, {}, *regions_);
  }

  Identifier identifier_;
  std::unique_ptr<Regions> regions_ = std::make_unique<Regions>();
};

// Pairs of pixels on a grid.
Picture pairs(int width_px, int height_px) {
  Picture picture(width_px, height_px);
  for (int y = 0; y < height_px; y += 2) {
    for (int x = 0; x + 1 < width_px; x += 4) {
      picture.at(x, y) = 255;
      picture.at(x + 1, y) = 255;
    }
  }
  return picture;
}

// Every other column: as many runs in a row as can be.
Picture columns(int width_px, int height_px) {
  Picture picture(width_px, height_px);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; x += 2) picture.at(x, y) = 200;
  }
  return picture;
}

TEST_F(IdentifyCapacity, KeepsTheFirstRegionsAndCountsTheOthers) {
  const Picture picture = pairs(400, 100);  // 100 x 50
  const IdentifyCounts counts = identify(picture);
  EXPECT_EQ(counts.components, 5000U);
  EXPECT_EQ(counts.accepted, core::kMaxRegions);
  EXPECT_EQ(counts.overflow_regions, 5000U - core::kMaxRegions);
  int comparisons = 0;
  expect_equal(plain_identify(picture, whole(picture), kBright, {}), counts, *regions_,
               comparisons);
  EXPECT_EQ(comparisons, static_cast<int>(core::kMaxRegions));
}

TEST_F(IdentifyCapacity, LeavesOutTheRowsWhoseRunsDoNotFit) {
  const IdentifyCounts counts = identify(columns(2047, 2048));  // 1024 runs a row
  const std::uint32_t rows = counts.runs / 1024;
  EXPECT_EQ(counts.runs, rows * 1024);
  EXPECT_GE(counts.runs, 65536U);
  EXPECT_LT(rows, 2048U);
  EXPECT_EQ(counts.overflow_runs, (2048 - rows) * 1024);
  EXPECT_EQ(counts.components, 1024U);
  ASSERT_EQ(regions_->size(), core::kMaxRegions);
  for (const Region& region : *regions_) {
    EXPECT_EQ(region.area_px, static_cast<int>(rows));
    EXPECT_TRUE(region.touches_border);  // of what was searched
  }
}

TEST_F(IdentifyCapacity, ARegionCutByTheLastSearchedRowTouchesTheBorder) {
  Picture picture = columns(2047, 2048);
  for (int y = 0; y < 2048; ++y) {
    for (int x = 0; x < 100; ++x) picture.at(x, y) = 0;
    picture.at(10, y) = 255;  // a line across the border of what is searched
  }
  const IdentifyCounts counts = identify(picture);
  EXPECT_GT(counts.overflow_runs, 0U);
  ASSERT_FALSE(regions_->empty());
  EXPECT_EQ(regions_->front().x_min, 10);
  EXPECT_TRUE(regions_->front().touches_border);
}

TEST_F(IdentifyCapacity, AnOverflowLeavesNoTrace) {
  identify(columns(2047, 2048));
  Random random(5);
  int comparisons = 0;
  for (int i = 0; i < 20; ++i) {
    const Picture picture = random_picture(random, 150);
    const IdentifyCounts counts = identify(picture);
    expect_equal(plain_identify(picture, whole(picture), kBright, {}), counts, *regions_,
                 comparisons);
  }
  EXPECT_GT(comparisons, 300);
}

TEST_F(IdentifyCapacity, ACheckerboardIsAllSinglePixels) {
  Picture picture(2048, 2048);
  for (int y = 0; y < 2048; ++y) {
    for (int x = y % 2; x < 2048; x += 2) picture.at(x, y) = 255;
  }
  const IdentifyCounts counts = identify(picture);
  EXPECT_EQ(counts.runs, 0U);
  EXPECT_EQ(counts.components, 0U);
  EXPECT_TRUE(regions_->empty());
}

TEST_F(IdentifyCapacity, AllWhiteIsOneRegionAndAllBlackNone) {
  Picture picture(2048, 2048);
  EXPECT_EQ(identify(picture).components, 0U);
  picture.fill(255);
  const IdentifyCounts counts = identify(picture);
  EXPECT_EQ(counts.runs, 2048U);
  ASSERT_EQ(counts.accepted, 1U);
  const Region& region = regions_->front();
  EXPECT_EQ(region.area_px, 2048 * 2048);
  EXPECT_EQ(region.saturated_px, 2048 * 2048);
  EXPECT_NEAR(region.centroid_px.x(), 1023.5, 1e-9);
  EXPECT_NEAR(region.centroid_px.y(), 1023.5, 1e-9);
  EXPECT_NEAR(region.semi_major_px, 2048.0 / std::sqrt(3.0), 1e-6);  // of a square
  EXPECT_NEAR(region.semi_minor_px, 2048.0 / std::sqrt(3.0), 1e-6);
  EXPECT_TRUE(region.touches_border);
}

TEST_F(IdentifyCapacity, PureNoiseOfTheLargestImage) {
  Random random(11);
  Picture picture(2048, 2048);
  add_noise(picture, random, 0, 255);
  const IdentifyCounts counts = identify(picture);
  EXPECT_GT(counts.overflow_runs, 0U);
  EXPECT_GT(counts.components, 1000U);
  EXPECT_EQ(counts.components, counts.rejected_size + counts.rejected_shape + counts.accepted +
                                   counts.overflow_regions);
}

TEST_F(IdentifyCapacity, AnImageThatIsEmptyOrTooLargeGivesNothing) {
  EXPECT_EQ(identifier_.identify(ImageView{}, kBright, {}, *regions_).runs, 0U);
  Picture wide(2049, 3);
  wide.fill(255);
  EXPECT_EQ(identify(wide).runs, 0U);
  Picture high(3, 2049);
  high.fill(255);
  EXPECT_EQ(identify(high).runs, 0U);
  EXPECT_TRUE(regions_->empty());
}

TEST_F(IdentifyCapacity, AWindowOutsideTheImageGivesNothing) {
  Picture picture(50, 40);
  picture.fill(255);
  int windows = 0;
  for (const Window& window : {Window{50, 0, 60, 10}, Window{0, 40, 10, 50}, Window{-10, 0, -1, 10},
                               Window{0, -10, 10, -1}, Window{20, 20, 10, 30}}) {
    const IdentifyCounts counts =
        identifier_.identify(picture.view(), window, kBright, {}, *regions_);
    EXPECT_EQ(counts.runs, 0U);
    EXPECT_TRUE(regions_->empty());
    ++windows;
  }
  EXPECT_EQ(windows, 5);
}

TEST_F(IdentifyCapacity, AnEmptyBandGivesNothing) {
  Picture picture(50, 40);
  picture.fill(255);
  int bands = 0;
  for (const Band& band : {Band{.intensity_min_dn = 256, .intensity_max_dn = 300},
                           Band{.intensity_min_dn = 200, .intensity_max_dn = 100},
                           Band{.intensity_min_dn = -20, .intensity_max_dn = -1}}) {
    EXPECT_EQ(identifier_.identify(picture.view(), band, {}, *regions_).runs, 0U);
    EXPECT_TRUE(regions_->empty());
    ++bands;
  }
  EXPECT_EQ(bands, 3);
}

TEST_F(IdentifyCapacity, SaysHowLargeItIs) {
  EXPECT_GT(identifier_.footprint_bytes(), 1U << 20U);
  EXPECT_LT(identifier_.footprint_bytes(), 16U << 20U);
}

}  // namespace
}  // namespace dottrack::image::test
