#include "app/core/image/dot_centre.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "app/core/image/identify.h"

namespace dottrack::image {
namespace {

struct Disc {
  Eigen::Vector2d centre{32.0, 32.0};
  double diameter_px = 8.0;
  double contrast_dn = 120.0;
  double blur_px = 0.6;
  double slope_dn = 0.0;  // of the background, a pixel in x
  double noise_dn = 0.0;
};

constexpr int kSize = 64;

// A blurred disc: its edge as a Gaussian step across the radius, averaged over 4 x 4 samples a
// pixel.
double coverage(const Disc& disc, int x, int y) {
  double sum = 0.0;
  for (int i = 0; i < 16; ++i) {
    const Eigen::Vector2d p(x + (i % 4 - 1.5) / 4.0, y + (i / 4 - 1.5) / 4.0);
    const double inside = 0.5 * disc.diameter_px - (p - disc.centre).norm();
    sum += 0.5 * std::erfc(-inside / (disc.blur_px * std::numbers::sqrt2));
  }
  return sum / 16.0;
}

std::vector<std::uint8_t> paint(const Disc& disc, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<std::uint8_t> image;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double grey = 60.0 + disc.slope_dn * (x - 32) +
                          disc.contrast_dn * coverage(disc, x, y) + disc.noise_dn * noise(random);
      image.push_back(static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L)));
    }
  }
  return image;
}

class DotCentreTest : public testing::Test {
 protected:
  // Errors of the region's own centroid and of dot_centre, pixels.
  struct Errors {
    Eigen::Vector2d region;
    Eigen::Vector2d centre;
  };

  Errors measure(const Disc& disc) {
    const std::vector<std::uint8_t> image = paint(disc, random_);
    const ImageView view{image.data(), kSize, kSize, kSize};
    Band band;
    band.min_contrast_dn = static_cast<int>(0.3 * disc.contrast_dn);
    RegionGate gate;
    gate.min_area_px = 6;
    identifier_.identify(view, band, gate, regions_);
    EXPECT_EQ(regions_.size(), 1U);
    if (regions_.empty()) return {};
    return {regions_[0].centroid_px - disc.centre, dot_centre(view, regions_[0]) - disc.centre};
  }

  Eigen::Vector2d anywhere() {
    std::uniform_real_distribution<double> part(-0.5, 0.5);
    return {32.0 + part(random_), 32.0 + part(random_)};
  }

  std::mt19937 random_{3};
  Identifier identifier_;
  Regions regions_;
};

// Standard deviation in x of the best unbiased estimator of a blurred disc's centre.
double cramer_rao_px(const Disc& disc) {
  const double edge = std::sqrt(disc.blur_px * disc.blur_px + 1.0 / 12.0);
  return disc.noise_dn / disc.contrast_dn *
         std::sqrt(4.0 * std::sqrt(std::numbers::pi) * edge /
                   (std::numbers::pi * disc.diameter_px));
}

TEST_F(DotCentreTest, IsExactWithoutNoise) {
  for (const double diameter : {5.0, 8.0, 14.0, 20.0}) {
    for (int i = 0; i < 20; ++i) {
      EXPECT_LT(measure({.centre = anywhere(), .diameter_px = diameter}).centre.norm(), 0.02);
    }
  }
}

TEST_F(DotCentreTest, StaysNearTheBound) {
  for (const double diameter : {6.0, 8.0, 14.0}) {
    Disc disc{.diameter_px = diameter, .noise_dn = 6.0};
    double sum2 = 0.0;
    constexpr int kTrials = 300;
    for (int i = 0; i < kTrials; ++i) {
      disc.centre = anywhere();
      sum2 += measure(disc).centre.squaredNorm() / (2.0 * kTrials);
    }
    EXPECT_LT(std::sqrt(sum2), 1.6 * cramer_rao_px(disc)) << diameter;
    EXPECT_GT(std::sqrt(sum2), 0.9 * cramer_rao_px(disc)) << diameter << ": too good to be true";
  }
}

TEST_F(DotCentreTest, ASlopingBackgroundDoesNotPullIt) {
  double worst_px = 0.0;
  double worst_region_px = 0.0;
  for (int i = 0; i < 30; ++i) {
    const Errors errors = measure({.centre = anywhere(), .slope_dn = 1.0});
    worst_px = std::max(worst_px, errors.centre.norm());
    worst_region_px = std::max(worst_region_px, errors.region.norm());
  }
  EXPECT_LT(worst_px, 0.03);
  EXPECT_GT(worst_region_px, worst_px);
}

TEST_F(DotCentreTest, DarkDotsHaveACentreToo) {
  for (int i = 0; i < 20; ++i) {
    Disc disc{.centre = anywhere(), .contrast_dn = 120.0, .slope_dn = 0.5};
    std::vector<std::uint8_t> image = paint(disc, random_);
    const ImageView view{image.data(), kSize, kSize, kSize};
    for (std::uint8_t& pixel : image) pixel = static_cast<std::uint8_t>(255 - pixel);
    Region region;
    region.centroid_px = disc.centre + Eigen::Vector2d(0.2, -0.1);
    region.semi_major_px = 4.4;
    region.semi_minor_px = 4.2;
    EXPECT_LT((dot_centre(view, region) - disc.centre).norm(), 0.03);
  }
}

// A second bright disc stands in the ring: its pixels are no background.
TEST_F(DotCentreTest, ANeighbourInTheRingDoesNotPullIt) {
  for (int i = 0; i < 20; ++i) {
    Disc disc{.centre = anywhere(), .noise_dn = 1.0};
    std::vector<std::uint8_t> image = paint(disc, random_);
    Disc neighbour{.centre = disc.centre + Eigen::Vector2d(11.0, 3.0), .diameter_px = 5.0};
    const std::vector<std::uint8_t> other = paint(neighbour, random_);
    for (std::size_t k = 0; k < image.size(); ++k) image[k] = std::max(image[k], other[k]);
    Region region;
    region.centroid_px = disc.centre + Eigen::Vector2d(0.2, -0.1);
    region.semi_major_px = 4.3;
    region.semi_minor_px = 4.3;
    EXPECT_LT((dot_centre({image.data(), kSize, kSize, kSize}, region) - disc.centre).norm(), 0.05);
  }
}

TEST_F(DotCentreTest, IsTheSameWhereverTheImageEnds) {
  constexpr int kWide = 400;
  for (int i = 0; i < 50; ++i) {
    const Disc disc{.centre = anywhere(), .slope_dn = 0.4, .noise_dn = 4.0};
    const std::vector<std::uint8_t> image = paint(disc, random_);
    std::vector<std::uint8_t> wide(std::size_t{kWide} * kSize, 200);
    for (std::size_t y = 0; y < kSize; ++y) {
      std::copy_n(image.begin() + static_cast<long>(y * kSize), kSize,
                  wide.begin() + static_cast<long>(y * kWide));
    }
    Region region;
    region.centroid_px = disc.centre;
    region.semi_major_px = 5.0;
    region.semi_minor_px = 4.0;
    region.angle_rad = 0.1 * i;
    const Eigen::Vector2d centre = dot_centre({image.data(), kSize, kSize, kSize}, region);
    EXPECT_NE(centre, region.centroid_px);
    EXPECT_EQ(dot_centre({wide.data(), kWide, kSize, kWide}, region), centre);
  }
}

// Cut off by the image's edges, down to nothing: some place in the picture or the region's own.
TEST_F(DotCentreTest, StaysByTheRegionAtTheImagesEdges) {
  const std::vector<std::uint8_t> image = paint({.noise_dn = 20.0}, random_);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int i = 0; i < 3000; ++i) {
    const int width = 1 + static_cast<int>(kSize * part(random_));
    const int height = 1 + static_cast<int>(kSize * part(random_));
    Region region;
    region.centroid_px = {(width - 1) * part(random_), (height - 1) * part(random_)};
    region.semi_major_px = 0.6 + 26.0 * part(random_);
    region.semi_minor_px = 0.5 + (region.semi_major_px - 0.5) * part(random_);
    region.angle_rad = 3.0 * part(random_) - 1.5;
    const Eigen::Vector2d centre =
        dot_centre({image.data(), std::min(width, kSize), std::min(height, kSize), kSize}, region);
    EXPECT_LE((centre - region.centroid_px).norm(), 0.5 * region.semi_minor_px + 1e-9);
  }
}

TEST_F(DotCentreTest, KeepsTheRegionsCentroidWhereTheDotIsTooLarge) {
  Region region;
  region.centroid_px = {32.25, 31.75};
  region.semi_major_px = 60.0;
  region.semi_minor_px = 60.0;
  const std::vector<std::uint8_t> image(kSize * kSize, 90);
  EXPECT_EQ(dot_centre({image.data(), kSize, kSize, kSize}, region), region.centroid_px);
}

TEST_F(DotCentreTest, KeepsTheRegionsCentroidWhereThereIsNoLight) {
  Region region;
  region.centroid_px = {32.25, 31.75};
  region.semi_major_px = 4.0;
  region.semi_minor_px = 4.0;
  const std::vector<std::uint8_t> image(kSize * kSize, 90);
  EXPECT_EQ(dot_centre({image.data(), kSize, kSize, kSize}, region), region.centroid_px);
}

}  // namespace
}  // namespace dottrack::image
