#include "host_sim/renderer/sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kPixels = kWidth * kHeight;

// Even light and no corner fall-off: radiance r gives 255 r DN.
SensorModel even() {
  SensorModel model;
  model.corner_falloff = 0.0;
  return model;
}

SensorModel noiseless() {
  SensorModel model = even();
  model.noise = false;
  return model;
}

GreyImage picture(const SensorModel& model, const FloatImage& light, const Exposure& exposure) {
  GreyImage image(light.width_px(), light.height_px());
  Sensor(model, light.width_px(), light.height_px()).expose(light, exposure, image);
  return image;
}

FloatImage flat(double dn) {
  return {kWidth, kHeight, static_cast<float>(dn / 255.0)};
}

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

Moments moments(const GreyImage& image) {
  Moments m;
  for (const std::uint8_t dn : image.pixels()) m.mean += dn;
  m.mean /= kPixels;
  for (const std::uint8_t dn : image.pixels()) m.variance += (dn - m.mean) * (dn - m.mean);
  m.variance /= kPixels;
  return m;
}

TEST(SensorTest, BrightnessIsLinearInLightExposureGainAndOpening) {
  SensorModel model = noiseless();
  model.black_level_dn = 7.0;
  model.sensitivity = 0.8;
  int tried = 0;
  for (const double radiance : {0.01, 0.1, 0.3}) {
    for (const double duration_s : {0.001, 0.004, 0.010}) {
      for (const double gain : {0.5, 1.0, 3.0}) {
        for (const double opening : {0.1, 0.5, 1.0}) {
          const double dn =
              7.0 + 255.0 * 0.8 * radiance * (duration_s / kReferenceExposure_s) * gain * opening;
          if (dn > 254.0) continue;
          const FloatImage light(3, 2, static_cast<float>(radiance));
          const Exposure exposure{0.0, duration_s, gain, opening, {}};
          EXPECT_NEAR(picture(model, light, exposure).at(1, 1), dn, 0.501);
          ++tried;
        }
      }
    }
  }
  EXPECT_GE(tried, 70);
}

TEST(SensorTest, LightFallsOffTowardsTheCorners) {
  SensorModel model = noiseless();
  model.corner_falloff = 0.4;
  const GreyImage image = picture(model, flat(200.0), {});
  EXPECT_EQ(image.at(320, 240), 200);
  EXPECT_EQ(image.at(0, 0), 120);
  EXPECT_EQ(image.at(639, 479), 120);
  EXPECT_NEAR(image.at(639, 240), 200.0 * (1.0 - 0.4 * 0.64), 0.6);
}

struct NoiseCase {
  double dn;  // in the picture
  double gain;
};

class SensorNoiseTest : public testing::TestWithParam<NoiseCase> {};

// Variance in the picture: gain^2 (read noise^2 + charge / electrons), and 1/12 by rounding.
TEST_P(SensorNoiseTest, HasTheConfiguredVarianceAndNoBias) {
  const auto [dn, gain] = GetParam();
  SensorModel model = even();
  model.read_noise_dn = 1.5;
  model.electrons_per_dn = 30.0;
  const double charge_dn = dn / gain;
  const double variance = gain * gain * (1.5 * 1.5 + charge_dn / 30.0) + 1.0 / 12.0;
  const Moments m = moments(picture(model, flat(charge_dn), {.gain = gain, .noise = {1, 2, 3}}));
  EXPECT_NEAR(m.mean, dn, 4.5 * std::sqrt(variance / kPixels));
  EXPECT_NEAR(m.variance / variance, 1.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Levels, SensorNoiseTest,
                         testing::Values(NoiseCase{20.0, 1.0}, NoiseCase{60.25, 1.0},
                                         NoiseCase{120.5, 1.0}, NoiseCase{200.75, 1.0},
                                         NoiseCase{60.3, 4.0}, NoiseCase{180.6, 4.0},
                                         NoiseCase{100.4, 0.5}));

// A picture of nothing but read noise of 20 DN about 128.
GreyImage noise_picture(const NoiseKey& key) {
  SensorModel model = even();
  model.read_noise_dn = 20.0;
  model.electrons_per_dn = 1e9;
  return picture(model, flat(128.0), {.noise = key});
}

TEST(SensorTest, NoiseIsNormalOutToFourSigma) {
  std::vector<double> beyond(5, 0.0);
  constexpr int kTicks = 4;
  for (std::uint64_t tick = 0; tick < kTicks; ++tick) {
    const GreyImage image = noise_picture({5, 6, tick});
    for (const std::uint8_t dn : image.pixels()) {
      const int off = std::abs(dn - 128);
      for (int sigmas = 0; sigmas < 5; ++sigmas) {
        if (off > 20 * sigmas) beyond[static_cast<std::size_t>(sigmas)] += 1.0;
      }
    }
  }
  for (int sigmas = 0; sigmas < 5; ++sigmas) {
    const double share = std::erfc((20 * sigmas + 0.5) / 20.0 / std::sqrt(2.0));
    const double expected = share * kTicks * kPixels;
    EXPECT_NEAR(beyond[static_cast<std::size_t>(sigmas)], expected, 4.5 * std::sqrt(expected));
  }
}

// Of the pixels of `a` with those of `b` that lie (dx, dy) away.
double correlation(const GreyImage& a, const GreyImage& b, int dx, int dy) {
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y + dy < kHeight; ++y) {
    for (int x = 0; x + dx < kWidth; ++x, ++count) {
      sum += (a.at(x, y) - 128.0) * (b.at(x + dx, y + dy) - 128.0);
    }
  }
  return sum / count / 400.0;
}

TEST(SensorTest, NoiseIsWhite) {
  constexpr double kBound = 0.0085;  // 4.7 standard deviations of what chance does
  const GreyImage image = noise_picture({5, 6, 7});
  EXPECT_NEAR(correlation(image, image, 0, 0), 1.0, 0.01);
  for (int dx = 1; dx <= 8; ++dx) EXPECT_LT(std::abs(correlation(image, image, dx, 0)), kBound);
  for (int dy = 1; dy <= 3; ++dy) {
    for (int dx = 0; dx <= 4; ++dx) EXPECT_LT(std::abs(correlation(image, image, dx, dy)), kBound);
  }
  for (const NoiseKey& other : {NoiseKey{5, 6, 8}, NoiseKey{5, 7, 7}, NoiseKey{6, 6, 7},
                                NoiseKey{5, 7, 6}, NoiseKey{6, 5, 7}}) {
    const GreyImage another = noise_picture(other);
    for (int dx = 0; dx <= 4; ++dx) {
      EXPECT_LT(std::abs(correlation(image, another, dx, 0)), kBound);
    }
  }
}

TEST(SensorTest, APictureIsAPureFunctionOfLightAndKey) {
  SensorModel model = even();
  model.bloom_share = 0.9;
  FloatImage bright = flat(100.0);
  for (int y = 100; y < 110; ++y) bright.at(300, y) = 9.0F;
  const Exposure exposure{.gain = 1.3, .noise = {1, 2, 3}};
  const GreyImage fresh = picture(model, bright, exposure);
  Sensor used(model, kWidth, kHeight);
  GreyImage image(kWidth, kHeight);
  used.expose(flat(4000.0), {.noise = {9, 9, 9}}, image);
  used.expose(bright, exposure, image);
  EXPECT_EQ(image.pixels(), fresh.pixels());
  used.expose(flat(100.0), exposure, image);
  EXPECT_EQ(image.pixels(), picture(model, flat(100.0), exposure).pixels());
  EXPECT_NE(image.pixels(),
            picture(model, flat(100.0), {.gain = 1.3, .noise = {1, 2, 4}}).pixels());
}

TEST(SensorTest, SaturationClips) {
  const SensorModel model = noiseless();
  EXPECT_EQ(picture(model, flat(254.4), {}).at(5, 5), 254);
  EXPECT_EQ(picture(model, flat(5000.0), {}).at(5, 5), 255);
  // The charge is full before the gain: half of 280.
  EXPECT_EQ(picture(model, flat(5000.0), {.gain = 0.5}).at(5, 5), 140);
}

// Wells of 200 DN and a dot of 5 x 9 pixels at 600 DN before a background of 20: each column has
// 3600 DN too much, and what is left of the wells nearby is 180 DN a pixel.
SensorModel blooming(double share) {
  SensorModel model = noiseless();
  model.full_well_dn = 200.0;
  model.bloom_share = share;
  return model;
}

FloatImage bright_dot(int top, double dn) {
  FloatImage light = flat(20.0);
  for (int y = top; y < top + 9; ++y) {
    for (int x = 100; x < 105; ++x) light.at(x, y) = static_cast<float>(dn / 255.0);
  }
  return light;
}

struct Column {
  int first = -1;
  int last = -1;
  double sum_dn = 0.0;
  double centroid_px = 0.0;
};

Column above_background(const GreyImage& image, int x) {
  Column column;
  for (int y = 0; y < kHeight; ++y) {
    const double excess = image.at(x, y) - 20.0;
    if (excess <= 0.5) continue;
    if (column.first < 0) column.first = y;
    column.last = y;
    column.sum_dn += excess;
    column.centroid_px += excess * y;
  }
  column.centroid_px /= column.sum_dn;
  return column;
}

TEST(SensorTest, BloomingGrowsADotAlongItsColumnsAndMostlyDownwards) {
  const GreyImage image = picture(blooming(1.0), bright_dot(200, 600.0), {});
  const Column column = above_background(image, 102);
  EXPECT_EQ(column.first, 200 - 5);  // 900 DN upwards
  EXPECT_EQ(column.last, 208 + 15);  // 2700 DN downwards
  EXPECT_NEAR(column.centroid_px, 204.0 + 5.0, 0.01);
  EXPECT_NEAR(column.sum_dn, 9 * 580.0, 1.0);  // nothing is lost
  for (const int x : {99, 105}) EXPECT_EQ(above_background(image, x).first, -1);
}

TEST(SensorTest, WhatDoesNotBloomIsLost) {
  const Column half = above_background(picture(blooming(0.5), bright_dot(200, 600.0), {}), 102);
  EXPECT_EQ(half.first, 200 - 3);  // 2.5 pixels
  EXPECT_EQ(half.last, 208 + 8);   // 7.5 pixels
  EXPECT_NEAR(half.sum_dn, 9 * 180.0 + 0.5 * 3600.0, 2.0);
  const Column none = above_background(picture(blooming(0.0), bright_dot(200, 600.0), {}), 102);
  EXPECT_EQ(none.first, 200);
  EXPECT_EQ(none.last, 208);
  EXPECT_NEAR(none.sum_dn, 9 * 180.0, 1.0);
}

TEST(SensorTest, BloomingEndsAtThePicturesEdge) {
  const Column column =
      above_background(picture(blooming(1.0), bright_dot(kHeight - 12, 600.0), {}), 102);
  EXPECT_EQ(column.first, kHeight - 12 - 5);
  EXPECT_EQ(column.last, kHeight - 1);
}

TEST(SensorTest, AnUnsaturatedDotBesideABloomingOneIsUntouched) {
  FloatImage light = bright_dot(200, 600.0);
  for (int y = 205; y < 214; ++y) light.at(300, y) = 180.0F / 255.0F;
  const GreyImage image = picture(blooming(1.0), light, {});
  const GreyImage alone = picture(blooming(1.0), bright_dot(200, 199.0), {});
  for (int y = 0; y < kHeight; ++y) {
    EXPECT_EQ(image.at(300, y), y >= 205 && y < 214 ? 180 : 20);
    EXPECT_EQ(alone.at(102, y), y >= 200 && y < 209 ? 199 : 20);
  }
}

FloatImage blurred(const FloatImage& light, double sigma_px) {
  FloatImage out(light.width_px(), light.height_px());
  blur(light, {0, 0, light.width_px(), light.height_px()}, sigma_px, out);
  return out;
}

TEST(BlurTest, SpreadsAPointAsAGaussian) {
  FloatImage light(41, 41);
  light.at(20, 20) = 1.0F;
  for (const double sigma_px : {0.6, 1.0, 2.0}) {
    const FloatImage out = blurred(light, sigma_px);
    double sum = 0.0;
    double xx = 0.0;
    double yy = 0.0;
    for (int y = 0; y < 41; ++y) {
      for (int x = 0; x < 41; ++x) {
        const double value = static_cast<double>(out.at(x, y));
        sum += value;
        xx += value * (x - 20) * (x - 20);
        yy += value * (y - 20) * (y - 20);
      }
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
    EXPECT_NEAR(std::sqrt(xx), sigma_px, 0.015 * sigma_px);
    EXPECT_NEAR(std::sqrt(yy), sigma_px, 0.015 * sigma_px);
    const auto ratio = static_cast<double>(out.at(21, 20) / out.at(20, 20));
    EXPECT_NEAR(ratio, std::exp(-0.5 / (sigma_px * sigma_px)), 1e-5);
    EXPECT_EQ(out.at(20 + blur_reach_px(sigma_px) + 1, 20), 0.0F);
    EXPECT_GT(out.at(20 + blur_reach_px(sigma_px), 20), 0.0F);
  }
}

TEST(BlurTest, RepeatsTheBorder) {
  const FloatImage out = blurred(FloatImage(9, 7, 0.5F), 1.0);
  for (const float value : out.pixels()) EXPECT_NEAR(value, 0.5F, 1e-6F);
}

FloatImage pattern(int width, int height) {
  FloatImage light(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) light.at(x, y) = static_cast<float>((x * 7 + y * 13) % 29);
  }
  return light;
}

TEST(BlurTest, APartIsThatPartOfTheWhole) {
  const FloatImage light = pattern(50, 40);
  const FloatImage whole = blurred(light, 0.8);
  for (const PixelBox& box : {PixelBox{10, 12, 23, 30}, PixelBox{0, 0, 3, 40},
                              PixelBox{48, 38, 50, 40}, PixelBox{5, 5, 5, 9}}) {
    FloatImage part(50, 40, -1.0F);
    blur(light, box, 0.8, part);
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 50; ++x) {
        const bool inside = x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1;
        EXPECT_EQ(part.at(x, y), inside ? whole.at(x, y) : -1.0F);
      }
    }
  }
}

TEST(BlurTest, NoBlurIsACopy) {
  EXPECT_EQ(blurred(pattern(20, 10), 0.0).pixels(), pattern(20, 10).pixels());
  EXPECT_EQ(blur_reach_px(0.0), 0);
}

}  // namespace
}  // namespace dottrack::host_sim
