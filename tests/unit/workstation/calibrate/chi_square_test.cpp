#include "app/workstation/calibrate/fit/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dottrack::calibrate {
namespace {

TEST(ChiSquare, IsThatOfTables) {
  EXPECT_NEAR(surprise2(5.991), -std::log(0.05), 1e-3);
  EXPECT_NEAR(surprise3(7.815), -std::log(0.05), 1e-3);
  EXPECT_NEAR(surprise3(11.345), -std::log(0.01), 1e-3);
  EXPECT_NEAR(surprise2(kMedian2), std::log(2.0), 1e-9);
  EXPECT_NEAR(surprise3(kMedian3), std::log(2.0), 1e-9);
  EXPECT_NEAR(surprise3(0.0), 0.0, 1e-12);
}

TEST(ChiSquare, GoesOnWhereProbabilitiesVanish) {
  double before = 0.0;
  for (double sum = 1.0; sum < 1e7; sum *= 1.3) {
    const double now = surprise3(sum);
    ASSERT_GT(now, before);
    ASSERT_TRUE(std::isfinite(now));
    ASSERT_LT(now, surprise2(sum));  // three are larger more easily than two
    before = now;
  }
}

TEST(ChiSquare, SaysItInStandardDeviations) {
  EXPECT_NEAR(as_sigmas(-std::log(0.3173105)), 1.0, 1e-5);
  EXPECT_NEAR(as_sigmas(-std::log(0.0026998)), 3.0, 1e-4);
  EXPECT_GT(as_sigmas(5000.0), 99.0);
}

}  // namespace
}  // namespace dottrack::calibrate
