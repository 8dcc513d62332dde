#include "app/core/geometry/radial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dottrack::geometry {
namespace {

TEST(RadialPolynomial, KnowsItsFold) {
  const RadialPolynomial barrel{1.0, -0.3, 0.0};
  EXPECT_TRUE(barrel.rises_to_square(1.11));
  EXPECT_FALSE(barrel.rises_to_square(1.12));
  const RadialPolynomial wavy{1.0, -0.5, 0.06};  // turns, and rises again from 4.2
  EXPECT_TRUE(wavy.rises_to_square(0.79));
  EXPECT_FALSE(wavy.rises_to_square(0.80));
  EXPECT_FALSE(wavy.rises_to_square(100.0));
  EXPECT_TRUE((RadialPolynomial{1.0, -0.18, 0.04}.rises_to_square(1e9)));
  EXPECT_FALSE((RadialPolynomial{-0.1, 1.0, 1.0}.rises_to_square(10.0)));
}

// By brute force: the slope sampled densely up to the radius.
bool rises_by_sampling(const RadialPolynomial& p, double r) {
  for (int i = 0; i <= 2000; ++i) {
    if (!(p.slope(r * i / 2000.0) > 0.0)) return false;
  }
  return true;
}

TEST(RadialPolynomial, InversionFindsTheRisingBranchOrSaysThereIsNone) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> coefficient(-0.6, 0.6);
  std::uniform_real_distribution<double> radius(0.0, 4.0);
  int inverted = 0;
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    const RadialPolynomial p{1.0 + 0.01 * coefficient(generator), coefficient(generator),
                             0.3 * coefficient(generator)};
    const double expected = radius(generator);
    const double target = p.value(expected);
    if (target <= 0.0) continue;
    double r = -7.0;
    const OpticsStatus status = invert(p, target, target, r);
    if (status == OpticsStatus::ok) {
      ++inverted;
      ASSERT_TRUE(rises_by_sampling(p, 0.9999 * r)) << i;
      ASSERT_NEAR(p.value(r), target, 1e-14 * (1.0 + r * r * r * r * r)) << i;
    } else {
      ++refused;
      ASSERT_EQ(status, OpticsStatus::outside_domain) << i;
      EXPECT_EQ(r, -7.0);
    }
    if (rises_by_sampling(p, expected)) {
      ASSERT_EQ(status, OpticsStatus::ok) << i;
      ASSERT_NEAR(r, expected, 1e-13 * (1.0 + expected) / p.slope(expected)) << i;
    }
  }
  EXPECT_GE(inverted, 8000);
  EXPECT_GE(refused, 300);
}

TEST(RadialPolynomial, InversionReachesFarTargets) {
  const RadialPolynomial p{1.0, -0.18, 0.04};
  for (const double expected : {0.0, 1e-12, 1.0, 1e3, 1e6}) {
    double r = -7.0;
    ASSERT_EQ(invert(p, p.value(expected), 1.0, r), OpticsStatus::ok);
    EXPECT_NEAR(r, expected, 1e-14 * expected);
  }
}

}  // namespace
}  // namespace dottrack::geometry
