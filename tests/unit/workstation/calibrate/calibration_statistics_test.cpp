// What twelve cameras and sixty dots surveyed to a millimetre reach, over twenty halls.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <set>
#include <string>

#include "app/config/camera_internal.h"
#include "app/workstation/calibrate/fit/calibration.h"
#include "tests/unit/workstation/calibrate/synthetic_hall.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kSeeds = 20;

// Squared sigmas of a camera's place and of where it points.
struct Off {
  double place = 0.0;     // of 3
  double pointing = 0.0;  // of 2
};

Off off(const CameraCalibration& c, const geometry::CameraModel& truth) {
  const geometry::Cahv t = config::linear_part(truth);
  const geometry::Cahv m = config::linear_part(c.model);
  Off out;
  const Vector3d place = m.c - t.c;
  out.place = place.dot(c.covariance.topLeftCorner<3, 3>().inverse() * place);
  const Vector3d across = t.a.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> basis;
  basis << across, t.a.cross(across);
  const Eigen::Vector2d turn = basis.transpose() * (m.a - t.a);
  const Eigen::Matrix2d covariance = basis.transpose() * c.covariance.block<3, 3>(3, 3) * basis;
  out.pointing = turn.dot(covariance.inverse() * turn);
  return out;
}

// The normal approximation of chi-square's bounds (Wilson and Hilferty).
double chi_square_quantile(double degrees, double z) {
  const double part = 2.0 / (9.0 * degrees);
  return degrees * std::pow(1.0 - part + z * std::sqrt(part), 3);
}

// In how many images the surveyed place of a dot would show clearly elsewhere than the dot.
std::size_t cameras_that_tell(const test::Hall& hall, std::size_t dot) {
  constexpr double kClearly_px = 0.5;
  std::size_t count = 0;
  for (std::size_t i = 0; i < hall.views.size(); ++i) {
    for (const Observation& o : hall.views[i].observations) {
      Eigen::Vector2d pixel;
      if (o.dot != dot) continue;
      if (project(hall.truths[i], hall.dots[dot].position_m, pixel) != geometry::OpticsStatus::ok) {
        continue;
      }
      count += (pixel - o.pixel).norm() > kClearly_px ? 1U : 0U;
    }
  }
  return count;
}

struct Tally {
  double square_px2 = 0.0;
  std::size_t points = 0;
  Off off;
  std::size_t suspects = 0;

  double rms_px() const { return std::sqrt(square_px2 / static_cast<double>(points)); }
};

void add_hall(const test::Hall& hall, const Calibration& found, std::uint64_t seed, Tally& tally) {
  for (std::size_t i = 0; i < found.cameras.size(); ++i) {
    std::size_t count = 0;
    const double rms = test::rms_on_unseen_px(hall, i, found.cameras[i].model, count);
    tally.square_px2 += rms * rms * static_cast<double>(count);
    tally.points += count;
  }
  // One camera of each hall: those of the same hall share the errors of its survey.
  const std::size_t one = seed % found.cameras.size();
  const Off o = off(found.cameras[one], hall.truths[one]);
  tally.off.place += o.place;
  tally.off.pointing += o.pointing;
  tally.suspects += found.suspects.size();
}

void over_all_seeds(test::HallOptions options, const CalibrationOptions& how, Tally& tally) {
  for (options.seed = 1; options.seed <= kSeeds; ++options.seed) {
    const test::Hall hall = test::make_hall(options);
    const auto found = calibrate(hall.dots, hall.views, how);
    ASSERT_TRUE(found) << found.error().message;
    add_hall(hall, *found, options.seed, tally);
  }
}

void expect_as_claimed(const Off& off) {
  EXPECT_GT(off.place, chi_square_quantile(3.0 * kSeeds, -1.96));
  EXPECT_LT(off.place, chi_square_quantile(3.0 * kSeeds, 1.96));
  EXPECT_GT(off.pointing, chi_square_quantile(2.0 * kSeeds, -1.96));
  EXPECT_LT(off.pointing, chi_square_quantile(2.0 * kSeeds, 1.96));
}

TEST(CalibrationStatistics, TwelveCamerasSixtyDots) {
  Tally tally;
  over_all_seeds({}, {}, tally);
  RecordProperty("rms_unseen_px", std::to_string(tally.rms_px()));
  EXPECT_GT(tally.points, 20000U);
  EXPECT_LE(tally.rms_px(), 0.05);  // far into the corners, where cameras see few dots
  EXPECT_EQ(tally.suspects, 0U);
  expect_as_claimed(tally.off);
}

// Lenses of one make that differ by a hundredth: to a third of a pixel in the corners.
TEST(CalibrationStatistics, LensesThatAreNotQuiteAlike) {
  test::HallOptions options;
  options.radial_sigma = 0.01;
  CalibrationOptions how;
  how.kind = ModelKind::cahvor;
  how.folds = 2;
  Tally tally;
  over_all_seeds(options, how, tally);
  RecordProperty("rms_unseen_px", std::to_string(tally.rms_px()));
  EXPECT_GT(tally.points, 20000U);
  EXPECT_LE(tally.rms_px(), 0.055);
  EXPECT_EQ(tally.suspects, 0U);
  expect_as_claimed(tally.off);
}

TEST(CalibrationStatistics, ThreeWronglySurveyedDotsOfSixtyAreNamed) {
  std::size_t seen = 0;
  std::size_t named = 0;
  std::size_t false_alarms = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    test::HallOptions options;
    options.seed = seed;
    test::Hall hall = test::make_hall(options);
    const std::set<std::size_t> wrong{5, 23, 47};
    hall.dots[5].position_m.x() += 0.015;
    hall.dots[23].position_m.y() -= 0.02;
    hall.dots[47].position_m.z() += 0.03;
    const auto found = calibrate(hall.dots, hall.views);
    ASSERT_TRUE(found) << found.error().message;
    // Two cameras cannot say whether the survey or one of them is wrong, and none sees a dot that
    // was moved along its line of sight.
    const auto told = [&](std::size_t dot) { return cameras_that_tell(hall, dot) >= 3; };
    for (const std::size_t dot : wrong) seen += told(dot) ? 1U : 0U;
    for (const SuspectDot& s : found->suspects) {
      if (!wrong.contains(s.dot)) ++false_alarms;
      if (wrong.contains(s.dot) && told(s.dot)) ++named;
    }
  }
  EXPECT_GE(seen, 45U);
  EXPECT_EQ(named, seen);
  EXPECT_EQ(false_alarms, 0U);
}

}  // namespace
}  // namespace dottrack::calibrate
