// Where a lens's description ends, the answer is a status and no output is touched.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "app/core/geometry/camera_model.h"

namespace dottrack::geometry {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Looks along +z from the origin; 500 pixels a radian, centre (320, 240).
Cahv pinhole() {
  return {{0, 0, 0}, {0, 0, 1}, {500, 0, 320}, {0, 500, 240}};
}

Cahvor distorting(const Eigen::Vector3d& r) {
  const Cahv m = pinhole();
  return {m.c, m.a, m.h, m.v, m.a, r};
}

Cahvore lens(double linearity, const Eigen::Vector3d& r = {0, 0, 0},
             const Eigen::Vector3d& e = {0, 0, 0}) {
  const Cahv m = pinhole();
  return {m.c, m.a, m.h, m.v, m.a, r, e, linearity};
}

Eigen::Vector3d at_angle(double degrees) {
  return 3.0 * Eigen::Vector3d(std::sin(degrees * kDegree), 0.0, std::cos(degrees * kDegree));
}

OpticsStatus project_status(const CameraModel& model, const Eigen::Vector3d& point) {
  Eigen::Vector2d pixel(-7.0, -7.0);
  ProjectionJacobian jacobian = ProjectionJacobian::Constant(-7.0);
  const OpticsStatus status = project(model, point, pixel, &jacobian);
  if (status != OpticsStatus::ok) {
    EXPECT_EQ(pixel, Eigen::Vector2d(-7.0, -7.0));
    EXPECT_EQ(jacobian, ProjectionJacobian::Constant(-7.0));
  } else {
    EXPECT_TRUE(pixel.allFinite() && jacobian.allFinite());
  }
  return status;
}

OpticsStatus unproject_status(const CameraModel& model, const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d untouched(-7.0, -7.0, -7.0);
  Ray ray{untouched, untouched};
  RayJacobian jacobian;
  jacobian.origin.setConstant(-7.0);
  jacobian.direction.setConstant(-7.0);
  const OpticsStatus status = unproject(model, pixel, ray, &jacobian);
  if (status != OpticsStatus::ok) {
    EXPECT_EQ(ray.origin, untouched);
    EXPECT_EQ(ray.direction, untouched);
    EXPECT_TRUE((jacobian.origin.array() == -7.0).all());
    EXPECT_TRUE((jacobian.direction.array() == -7.0).all());
  } else {
    EXPECT_TRUE(ray.origin.allFinite() && ray.direction.allFinite());
    EXPECT_TRUE(jacobian.origin.allFinite() && jacobian.direction.allFinite());
  }
  return status;
}

const CameraModel kEveryKind[] = {pinhole(),
                                  distorting({0, -0.1, 0.02}),
                                  lens(1.0, {0, -0.1, 0.02}, {1e-3, 0, 0}),
                                  lens(0.0, {0, -0.02, 0}, {1e-3, 0, 0}),
                                  lens(0.37),
                                  lens(-0.6)};

TEST(LensDomain, PointBehindAnyCameraIsBehind) {
  for (const CameraModel& model : kEveryKind) {
    SCOPED_TRACE(class_name(model));
    EXPECT_EQ(project_status(model, {0, 0, -3}), OpticsStatus::behind);
    EXPECT_EQ(project_status(model, {0.1, 0.2, -3}), OpticsStatus::behind);
    EXPECT_EQ(project_status(model, at_angle(150.0)), OpticsStatus::behind);
    EXPECT_EQ(project_status(model, at_angle(179.9)), OpticsStatus::behind);
  }
}

TEST(LensDomain, PointInThePlaneOfTheCentreIsBehindAPerspectiveCamera) {
  for (const CameraModel& model :
       {CameraModel(pinhole()), CameraModel(distorting({0, 0, 0})), CameraModel(lens(1.0))}) {
    SCOPED_TRACE(class_name(model));
    EXPECT_EQ(project_status(model, {3, 0, 0}), OpticsStatus::behind);
    EXPECT_EQ(project_status(model, {2, -1, 1e-17}), OpticsStatus::behind);
  }
}

TEST(LensDomain, TheCentreHasNoDirection) {
  for (const CameraModel& model : kEveryKind) {
    EXPECT_EQ(project_status(model, {0, 0, 0}), OpticsStatus::at_centre);
    EXPECT_EQ(project_status(model, {1e-13, 0, 1e-13}), OpticsStatus::at_centre);
  }
}

TEST(LensDomain, NaNAndInfinityAreNotFinite) {
  for (const CameraModel& model : kEveryKind) {
    SCOPED_TRACE(class_name(model));
    for (const double bad : {kNaN, kInfinity, -kInfinity}) {
      for (int k = 0; k < 3; ++k) {
        Eigen::Vector3d point(0.1, 0.2, 3.0);
        point[k] = bad;
        EXPECT_EQ(project_status(model, point), OpticsStatus::not_finite);
      }
      EXPECT_EQ(unproject_status(model, {bad, 10.0}), OpticsStatus::not_finite);
      EXPECT_EQ(unproject_status(model, {10.0, bad}), OpticsStatus::not_finite);
    }
  }
}

TEST(LensDomain, NumbersTooLargeToComputeWithNeverBecomePixels) {
  for (const CameraModel& model : kEveryKind) {
    EXPECT_EQ(project_status(model, {1e200, 0.0, 1e200}), OpticsStatus::not_finite);
    EXPECT_NE(unproject_status(model, {1e200, -1e200}), OpticsStatus::ok);
  }
}

TEST(LensDomain, AModelWithNaNGivesNoPixelAndNoRay) {
  for (int field = 0; field < 4; ++field) {
    Cahvore bad = lens(0.0);
    Eigen::Vector3d* const fields[] = {&bad.c, &bad.h, &bad.o, &bad.r};
    fields[field]->x() = kNaN;
    EXPECT_NE(project_status(bad, {0.1, 0.2, 3}), OpticsStatus::ok);
    if (field != 0) {
      EXPECT_NE(unproject_status(bad, {300, 200}), OpticsStatus::ok);
    }
    const Cahvor cahvor{bad.c, bad.a, bad.h, bad.v, bad.o, bad.r};
    EXPECT_NE(project_status(cahvor, {0.1, 0.2, 3}), OpticsStatus::ok);
    const Cahv cahv{bad.c, bad.a, bad.h, bad.v};
    if (field < 2) {
      EXPECT_NE(project_status(cahv, {0.1, 0.2, 3}), OpticsStatus::ok);
    }
  }
}

TEST(LensDomain, HAndVThatSpanNoImageGiveNoRay) {
  Cahv flat = pinhole();
  flat.v = flat.h;
  EXPECT_EQ(unproject_status(flat, {300, 200}), OpticsStatus::outside_domain);
}

// r (1 - 0.3 r^2) rises up to r = sqrt(1 / 0.9), 46.5 degrees, where it is 0.7027.
TEST(LensDomain, BarrelDistortionEndsAtItsFold) {
  const Cahvor barrel = distorting({0, -0.3, 0});
  EXPECT_EQ(project_status(barrel, at_angle(46.0)), OpticsStatus::ok);
  for (const double degrees : {47.0, 55.0, 70.0, 85.0, 89.0}) {
    EXPECT_EQ(project_status(barrel, at_angle(degrees)), OpticsStatus::outside_domain) << degrees;
  }
  const double edge_px = 500.0 * std::sqrt(1.0 / 0.9) * (2.0 / 3.0);
  EXPECT_EQ(unproject_status(barrel, {320.0 + 0.999 * edge_px, 240.0}), OpticsStatus::ok);
  EXPECT_EQ(unproject_status(barrel, {320.0 + 1.001 * edge_px, 240.0}),
            OpticsStatus::outside_domain);
  EXPECT_EQ(unproject_status(barrel, {1e6, 240.0}), OpticsStatus::outside_domain);
}

// The slope 1 - 1.5 s + 0.3 s^2 dips below zero between s = 0.79 and 4.2 and rises again.
TEST(LensDomain, BeyondAFoldThereIsNoSecondImage) {
  const Cahvor wavy = distorting({0, -0.5, 0.06});
  EXPECT_EQ(project_status(wavy, at_angle(40.0)), OpticsStatus::ok);
  for (const double degrees : {43.0, 60.0, 67.0, 75.0, 85.0}) {
    EXPECT_EQ(project_status(wavy, at_angle(degrees)), OpticsStatus::outside_domain) << degrees;
  }
  EXPECT_EQ(unproject_status(wavy, {320.0 + 500.0 * 2.0, 240.0}), OpticsStatus::outside_domain);
}

const Eigen::Vector3d kTilted = Eigen::Vector3d(0.1, 0.0, 1.0).normalized();

TEST(LensDomain, DistortionBehindTheImagePlaneIsOutside) {
  Cahvor cahvor = distorting({0, 0, 0.5});
  cahvor.o = kTilted;
  EXPECT_EQ(project_status(cahvor, at_angle(85.0)), OpticsStatus::outside_domain);
  Cahvore cahvore = lens(1.0, {0, 0.1, 0});
  cahvore.o = kTilted;
  EXPECT_EQ(project_status(cahvore, at_angle(85.0)), OpticsStatus::outside_domain);
}

// Half the radius in the image: a pixel 82 degrees from O comes from 86, which is 92 from A.
TEST(LensDomain, ARayBehindThePlaneOfTheCentreIsNone) {
  Cahvor halving = distorting({-0.5, 0, 0});
  halving.o = kTilted;
  const auto pixel_at = [](double degrees) {
    return Eigen::Vector2d(320.0 + 500.0 * std::tan(degrees * kDegree), 240.0);
  };
  EXPECT_EQ(unproject_status(halving, pixel_at(80.0)), OpticsStatus::ok);
  EXPECT_EQ(unproject_status(halving, pixel_at(87.7)), OpticsStatus::outside_domain);
}

TEST(LensDomain, PerspectiveEndsAtNinetyDegrees) {
  EXPECT_EQ(project_status(lens(1.0), at_angle(89.0)), OpticsStatus::ok);
  EXPECT_EQ(project_status(lens(1.0), at_angle(91.0)), OpticsStatus::behind);
}

TEST(LensDomain, AGeneralLensEndsWhereItsTangentDoes) {
  EXPECT_EQ(project_status(lens(0.8), at_angle(112.0)), OpticsStatus::ok);  // 90 / 0.8 = 112.5
  EXPECT_EQ(project_status(lens(0.8), at_angle(113.0)), OpticsStatus::behind);
}

TEST(LensDomain, ANegativeLinearityEndsWhereItsSineTurns) {
  EXPECT_EQ(project_status(lens(-1.5), at_angle(59.0)), OpticsStatus::ok);  // 90 / 1.5 = 60
  EXPECT_EQ(project_status(lens(-1.5), at_angle(61.0)), OpticsStatus::outside_domain);
  EXPECT_EQ(unproject_status(lens(-1.5), {320.0 + 500.0 * 0.66, 240.0}), OpticsStatus::ok);
  EXPECT_EQ(unproject_status(lens(-1.5), {320.0 + 500.0 * 0.67, 240.0}),
            OpticsStatus::outside_domain);
}

TEST(LensDomain, AFishEyeSeesBehindThePlaneButNotEverywhere) {
  EXPECT_EQ(project_status(lens(0.0), at_angle(110.0)), OpticsStatus::ok);
  EXPECT_EQ(project_status(lens(0.0), at_angle(139.0)), OpticsStatus::ok);
  EXPECT_EQ(project_status(lens(0.0), at_angle(141.0)), OpticsStatus::behind);
  EXPECT_EQ(unproject_status(lens(0.0), {320.0 + 500.0 * 139.0 * kDegree, 240.0}),
            OpticsStatus::ok);
  EXPECT_EQ(unproject_status(lens(0.0), {320.0 + 500.0 * 141.0 * kDegree, 240.0}),
            OpticsStatus::outside_domain);
}

// t (1 - 0.1 t^2) rises up to t = sqrt(1 / 0.3), 104.6 degrees.
TEST(LensDomain, AFishEyeEndsAtTheFoldOfItsPolynomial) {
  const Cahvore fish_eye = lens(0.0, {0, -0.1, 0});
  EXPECT_EQ(project_status(fish_eye, at_angle(80.0)), OpticsStatus::ok);
  EXPECT_EQ(project_status(fish_eye, at_angle(104.0)), OpticsStatus::ok);
  EXPECT_EQ(project_status(fish_eye, at_angle(105.5)), OpticsStatus::behind);
  const Cahvore narrow = lens(0.0, {0, -0.3, 0});  // 60.4 degrees
  EXPECT_EQ(project_status(narrow, at_angle(60.0)), OpticsStatus::ok);
  EXPECT_EQ(project_status(narrow, at_angle(61.0)), OpticsStatus::outside_domain);
}

TEST(LensDomain, AFoldAtTheAxisLeavesNothing) {
  EXPECT_EQ(project_status(distorting({-1.5, 0, 0}), {0, 0, 3}), OpticsStatus::outside_domain);
  EXPECT_EQ(project_status(lens(0.0, {-1.5, 0, 0}), {0, 0, 3}), OpticsStatus::outside_domain);
  EXPECT_EQ(unproject_status(distorting({-1.5, 0, 0}), {300, 200}), OpticsStatus::outside_domain);
  EXPECT_EQ(unproject_status(lens(0.0, {-1.5, 0, 0}), {300, 200}), OpticsStatus::outside_domain);
}

// Closer than the pupil's movement the equation for the angle has no answer to settle on.
TEST(LensDomain, InsideAHugePupilNothingIsMadeUp) {
  const Cahvore odd = lens(0.0, {0, 0, 0}, {5.0, 0, 0});
  const OpticsStatus status = project_status(odd, 0.01 * at_angle(60.0));
  EXPECT_NE(status, OpticsStatus::ok);
}

}  // namespace
}  // namespace dottrack::geometry
