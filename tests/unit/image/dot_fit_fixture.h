#pragma once
// Painted dots, as identify finds them and fit_dot measures them.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "app/core/image/dot_fit.h"
#include "app/core/image/identify.h"
#include "tests/unit/image/painted_dot.h"

namespace dottrack::image::test {

using Eigen::Vector2d;

inline constexpr int kSide_px = 48;
inline constexpr double kLevel_dn = 60.0;
inline constexpr double kContrast_dn = 120.0;
inline constexpr int kExposures = 30;  // of each painted dot

struct Setting {
  double diameter_px = 8.0;
  double contrast_to_noise = 20.0;
  double blur_px = 0.65;
  double slope_dn = 0.0;
  double contrast_dn = kContrast_dn;
  double per_dn = 0.0;  // shot noise

  Noise noise() const {
    if (per_dn > 0.0) return {1.0, per_dn};
    return {std::abs(contrast_dn) / contrast_to_noise, 0.0};
  }
};

class DotFitTest : public testing::Test {
 protected:
  PaintedEllipse disc(double diameter_px) {
    return {{24.0 + real(random_, -0.5, 0.5), 24.0 + real(random_, -0.5, 0.5)},
            diameter_px / 2.0,
            diameter_px / 2.0,
            0.0};
  }

  Canvas background(const Setting& setting) {
    Canvas canvas(kSide_px, setting.blur_px);
    canvas.add_level(setting.contrast_dn > 0.0 ? kLevel_dn : 255.0 - kLevel_dn);
    const double angle = real(random_, 0.0, 2.0 * std::numbers::pi);
    canvas.add_slope(setting.slope_dn * Vector2d(std::cos(angle), std::sin(angle)));
    return canvas;
  }

  // The region at a place, as identify finds it.
  std::optional<Region> region_at(const Picture& picture, const Vector2d& place,
                                  double contrast_dn) {
    Band band{.min_contrast_dn = static_cast<int>(0.4 * std::abs(contrast_dn)),
              .background_px = 61};
    band.polarity = contrast_dn > 0.0 ? core::Polarity::bright : core::Polarity::dark;
    RegionGate gate;
    gate.min_area_px = 4;
    identifier_->identify(picture.view(), band, gate, *regions_);
    std::optional<Region> nearest;
    double least_px = 4.0;
    for (const Region& region : *regions_) {
      const double off_px = (region.centroid_px - place).norm();
      if (off_px >= least_px) continue;
      least_px = off_px;
      nearest = region;
    }
    return nearest;
  }

  struct Errors {
    int count = 0;
    int flawed = 0;
    Vector2d sum = Vector2d::Zero();
    double sum2 = 0.0;      // per axis
    double weighed2 = 0.0;  // normalised squared errors

    double rms_px() const { return std::sqrt(sum2 / count); }
    double bias_px() const { return sum.norm() / count; }
    double nees() const { return weighed2 / count; }
  };

  void add(const DotFit& fit, const Vector2d& truth, Errors& errors) {
    const Vector2d error = fit.centre_px - truth;
    ++errors.count;
    if (fit.flaw != DotFlaw::none) ++errors.flawed;
    errors.sum += error;
    errors.sum2 += error.squaredNorm() / 2.0;
    errors.weighed2 += error.dot(fit.covariance_px2.inverse() * error);
  }

  Errors measure(const Setting& setting, int dots) {
    Errors errors;
    for (int i = 0; i < dots; ++i) {
      const PaintedEllipse ellipse = disc(setting.diameter_px);
      Canvas canvas = background(setting);
      canvas.paint(&ellipse, {}, setting.contrast_dn);
      const ExpectedOutline expected{ellipse.semi_major_px, ellipse.semi_minor_px, 0.0};
      for (int k = 0; k < kExposures; ++k) {
        const Picture picture = canvas.expose(setting.noise(), random_);
        const auto region = region_at(picture, ellipse.centre, setting.contrast_dn);
        if (!region) continue;
        add(fit_dot(picture.view(), *region, &expected), ellipse.centre, errors);
      }
    }
    return errors;
  }

  Random random_{17};
  std::unique_ptr<Identifier> identifier_ = std::make_unique<Identifier>();
  std::unique_ptr<Regions> regions_ = std::make_unique<Regions>();
};

}  // namespace dottrack::image::test
