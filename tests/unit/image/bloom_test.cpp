// Blooming against brightness, on dots that the simulated sensor exposes.

#include "app/core/image/bloom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/core/image/identify.h"
#include "host_sim/renderer/sensor.h"

namespace dottrack::image {
namespace {

constexpr int kSide_px = 64;

struct Dot {
  double semi_major_px = 6.0;
  double semi_minor_px = 6.0;
  double angle_rad = 0.0;
  double offset_px = 0.0;  // of its centre from a pixel's
};

// Radiance of a white dot on sand, pixels sampled 5 x 5, blurred as a lens does.
host_sim::FloatImage light_of(const Dot& dot) {
  host_sim::FloatImage sharp(kSide_px, kSide_px);
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = 0; x < kSide_px; ++x) {
      int inside = 0;
      for (int k = 0; k < 25; ++k) {
        const double dx = x + (k % 5 - 2) / 5.0 - 32.0 - dot.offset_px;
        const double dy = y + (k / 5 - 2) / 5.0 - 32.0 - dot.offset_px;
        const double u =
            (dx * std::cos(dot.angle_rad) + dy * std::sin(dot.angle_rad)) / dot.semi_major_px;
        const double v =
            (dy * std::cos(dot.angle_rad) - dx * std::sin(dot.angle_rad)) / dot.semi_minor_px;
        inside += u * u + v * v <= 1.0 ? 1 : 0;
      }
      sharp.at(x, y) = static_cast<float>(0.15 + 0.6 * inside / 25.0);
    }
  }
  host_sim::FloatImage blurred(kSide_px, kSide_px);
  host_sim::blur(sharp, {0, 0, kSide_px, kSide_px}, 0.6, blurred);
  return blurred;
}

// A dot of radiance 0.75, exposed so that it comes to this many times full scale.
BloomEvidence evidence(const Dot& dot, double full_scales, double bloom_share) {
  host_sim::SensorModel model;
  model.corner_falloff = 0.0;
  model.bloom_share = bloom_share;
  host_sim::Sensor sensor(model, kSide_px, kSide_px);
  host_sim::Exposure exposure;
  exposure.duration_s = host_sim::kReferenceExposure_s * full_scales / 0.75;
  host_sim::GreyImage grey;
  sensor.expose(light_of(dot), exposure, grey);
  const ImageView view{grey.pixels().data(), kSide_px, kSide_px, kSide_px};
  Identifier identifier;
  Regions regions;
  identifier.identify(
      view, {.intensity_min_dn = static_cast<int>(std::min(200.0, 255.0 * full_scales * 0.6))}, {},
      regions);
  EXPECT_EQ(regions.size(), 1U);
  if (regions.empty()) return {};
  return bloom_evidence(view, regions.front(),
                        extent_of(dot.semi_major_px, dot.semi_minor_px, dot.angle_rad));
}

std::vector<Dot> dots() {
  std::vector<Dot> dots;
  for (const double major : {4.0, 6.0, 9.0}) {
    for (const double ratio : {1.0, 0.6}) {
      for (const double angle : {0.0, 0.7, 1.5}) {
        for (const double offset : {0.0, 0.4})
          dots.push_back({major, ratio * major, angle, offset});
      }
    }
  }
  return dots;
}

TEST(Bloom, IsNotSeenInDotsThatAreMerelyBright) {
  int seen = 0;
  for (const Dot& dot : dots()) {
    for (const double full_scales : {0.75, 1.05, 1.2, 1.5, 1.9}) {
      const BloomEvidence found = evidence(dot, full_scales, 0.0);
      EXPECT_FALSE(found.bloomed())
          << dot.semi_major_px << " " << dot.semi_minor_px << " " << dot.angle_rad << " x "
          << full_scales << ": " << found.growth_px << " " << found.sag_px;
      seen += found.saturated_px > 0 ? 1 : 0;
    }
  }
  EXPECT_GE(seen, 36 * 3);
}

TEST(Bloom, IsSeenWhereChargeSpills) {
  int missed = 0;
  int looked_at = 0;
  for (const Dot& dot : dots()) {
    for (const double full_scales : {1.5, 1.7, 1.9}) {
      missed += evidence(dot, full_scales, 0.9).bloomed() ? 0 : 1;
      ++looked_at;
    }
  }
  EXPECT_EQ(looked_at, 36 * 3);
  RecordProperty("missed", missed);
  EXPECT_LE(missed, looked_at / 10);
}

TEST(Bloom, ADarkDotIsNone) {
  EXPECT_EQ(evidence({}, 0.5, 0.9).saturated_px, 0);
  EXPECT_FALSE(evidence({}, 0.5, 0.9).bloomed());
}

}  // namespace
}  // namespace dottrack::image
