#include <gtest/gtest.h>

#include <algorithm>

#include "app/workstation/calibrate/fit/calibration.h"
#include "tests/unit/workstation/calibrate/synthetic_hall.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double largest_difference_px(const Calibration& a, const Calibration& b, const test::Hall& hall,
                             std::size_t& compared) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.cameras.size(); ++i) {
    for (const Vector3d& p : hall.unseen_m) {
      Vector2d first;
      Vector2d second;
      if (project(a.cameras[i].model, p, first) != geometry::OpticsStatus::ok) continue;
      if (project(b.cameras[i].model, p, second) != geometry::OpticsStatus::ok) continue;
      if (first.x() < 0 || first.y() < 0 || first.x() > 640 || first.y() > 480) continue;
      most = std::max(most, (first - second).norm());
      ++compared;
    }
  }
  return most;
}

TEST(RandomStarts, EndInTheSamePlace) {
  test::HallOptions options_of_hall;
  options_of_hall.cameras = 4;
  options_of_hall.seed = 3;
  test::Hall hall = test::make_hall(options_of_hall);
  hall.views[1].observations[4].pixel.x() += 7.0;  // something to edit
  hall.dots[11].position_m.z() += 0.03;
  CalibrationOptions options;
  options.kind = ModelKind::cahvor;
  options.folds = 3;
  const auto first = calibrate(hall.dots, hall.views, options);
  ASSERT_TRUE(first);
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    options.seed = seed;
    const auto other = calibrate(hall.dots, hall.views, options);
    ASSERT_TRUE(other) << seed;
    EXPECT_LT(largest_difference_px(*first, *other, hall, compared), 1e-6) << seed;
    EXPECT_EQ(first->suspects.size(), other->suspects.size());
  }
  EXPECT_GT(compared, 5000U);
}

}  // namespace
}  // namespace dottrack::calibrate
