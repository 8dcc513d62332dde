// A disc's ellipse against the second moments of its outline, projected point by point.

#include "app/core/geometry/projected_circle.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/unit/geometry/random_cameras.h"

namespace dottrack::geometry {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::RandomCameras;

constexpr double kPi = std::numbers::pi;
// Of the axes and of the turn, in semi-major axes, over (radius over range) squared.
constexpr double kTolerancePerSquare = 1.5;

struct Disc {
  Vector3d centre;
  Vector3d normal;
  double radius_m = 0.0;
};

// False where the camera does not see the whole outline.
bool outline(const CameraModel& model, const Disc& disc, std::vector<Vector2d>& pixels) {
  constexpr int kPoints = 360;
  const Vector3d u = disc.normal.unitOrthogonal();
  const Vector3d v = disc.normal.cross(u);
  pixels.clear();
  for (int i = 0; i < kPoints; ++i) {
    const double t = 2.0 * kPi * i / kPoints;
    Vector2d pixel;
    const Vector3d point = disc.centre + disc.radius_m * (std::cos(t) * u + std::sin(t) * v);
    if (project(model, point, pixel) != OpticsStatus::ok) return false;
    pixels.push_back(pixel);
  }
  return true;
}

// The ellipse with the second moments of the area that a polygon encloses.
ImageEllipse ellipse_of(const std::vector<Vector2d>& polygon) {
  double area = 0.0;
  Vector2d first = Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  const Vector2d origin = polygon[0];
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d a = polygon[i] - origin;
    const Vector2d b = polygon[(i + 1) % polygon.size()] - origin;
    const double cross = a.x() * b.y() - a.y() * b.x();
    area += cross / 2.0;
    first += cross / 6.0 * (a + b);
    second +=
        cross / 24.0 *
        (2.0 * a * a.transpose() + 2.0 * b * b.transpose() + a * b.transpose() + b * a.transpose());
  }
  const Vector2d mean = first / area;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(second / area -
                                                              mean * mean.transpose());
  const Vector2d along = solver.eigenvectors().col(1);
  return {2.0 * std::sqrt(solver.eigenvalues()[1]), 2.0 * std::sqrt(solver.eigenvalues()[0]),
          std::atan2(along.y(), along.x())};
}

// Of the area that a polygon encloses.
Vector2d centroid(const std::vector<Vector2d>& polygon) {
  double twice_area = 0.0;
  Vector2d moment = Vector2d::Zero();
  const Vector2d origin = polygon[0];
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d a = polygon[i] - origin;
    const Vector2d b = polygon[(i + 1) % polygon.size()] - origin;
    const double cross = a.x() * b.y() - a.y() * b.x();
    twice_area += cross;
    moment += cross * (a + b);
  }
  return origin + moment / (3.0 * twice_area);
}

// How far the end of the major axis is off sideways, in semi-major axes; 0 for a circle.
double turned(const ImageEllipse& a, const ImageEllipse& b) {
  return std::abs(std::sin(a.angle_rad - b.angle_rad)) * (1.0 - a.semi_minor_px / a.semi_major_px);
}

class ProjectedCircle : public testing::Test {
 protected:
  // Seven in ten look at the camera at less than 66 degrees, the others at up to 78.
  Disc next_disc(const CameraModel& model, double radius_over_range) {
    const Vector3d axis = std::visit([](const auto& m) { return m.a; }, model);
    Disc disc;
    disc.centre = random_.point_near(centre(model), axis, 0.5, 2.0, 12.0);
    do {
      disc.normal = random_.unit();
    } while (facing(model, disc.centre, disc.normal) < 0.2);
    disc.radius_m = radius_over_range * (disc.centre - centre(model)).norm();
    return disc;
  }

  CameraModel next_model(int i) {
    if (i % 3 == 0) return random_.cahv();
    if (i % 3 == 1) return random_.cahvor();
    return random_.cahvore(i % 2 == 0 ? 1.0 : 0.0);
  }

  RandomCameras random_{7};
};

// Off by about the square of radius over range: at 0.05, which is a dot of 10 cm a metre away, by
// up to 0.3 % of the semi-major axis; at 0.01 by 0.01 %.
TEST_F(ProjectedCircle, IsTheOutlinesEllipseToSecondOrder) {
  for (const double part : {0.01, 0.02, 0.05}) {
    const double tolerance = kTolerancePerSquare * part * part;
    int judged = 0;
    double worst = 0.0;
    for (int i = 0; i < 1500; ++i) {
      const CameraModel model = next_model(i);
      const Disc disc = next_disc(model, part);
      std::vector<Vector2d> pixels;
      ImageEllipse seen;
      if (!outline(model, disc, pixels) ||
          project_disc(model, disc.centre, disc.normal, disc.radius_m, seen) != OpticsStatus::ok) {
        continue;
      }
      const ImageEllipse truth = ellipse_of(pixels);
      const double off = std::max(std::abs(seen.semi_major_px - truth.semi_major_px),
                                  std::abs(seen.semi_minor_px - truth.semi_minor_px)) /
                         truth.semi_major_px;
      worst = std::max({worst, off, turned(truth, seen)});
      ++judged;
    }
    EXPECT_LT(worst, tolerance) << part;
    EXPECT_GT(worst, 0.1 * tolerance) << part << ": too good to be true";
    EXPECT_GE(judged, 1400);
  }
}

// What is left of it, in all kinds of lenses; what distortion bends within a disc is not known to
// it.
TEST_F(ProjectedCircle, TheMiddleOfTheOutlineIsOffTheCentre) {
  double shift2 = 0.0;
  double left2[3] = {0.0, 0.0, 0.0};
  int judged[3] = {0, 0, 0};
  for (int i = 0; i < 3000; ++i) {
    const CameraModel model = next_model(i);
    const Disc disc = next_disc(model, 0.01);
    std::vector<Vector2d> pixels;
    Vector2d pixel;
    ProjectionJacobian jacobian;
    if (!outline(model, disc, pixels) ||
        project(model, disc.centre, pixel, &jacobian) != OpticsStatus::ok) {
      continue;
    }
    const Vector2d truth = centroid(pixels) - pixel;
    const Vector2d said =
        disc_eccentricity(model, disc.centre, pixel, jacobian, disc.normal, disc.radius_m);
    left2[i % 3] += (said - truth).squaredNorm();
    shift2 += truth.squaredNorm();
    ++judged[i % 3];
  }
  const int all = judged[0] + judged[1] + judged[2];
  EXPECT_GE(all, 2800);
  const double shift_px = std::sqrt(shift2 / all);
  EXPECT_GT(shift_px, 0.02);
  EXPECT_LT(std::sqrt(left2[0] / judged[0]), 0.002 * shift_px);
  EXPECT_LT(std::sqrt(left2[1] / judged[1]), 0.002 * shift_px);
  EXPECT_LT(std::sqrt(left2[2] / judged[2]), 0.002 * shift_px);
}

TEST_F(ProjectedCircle, ShowsTheSameEllipseFromBothSides) {
  for (int i = 0; i < 300; ++i) {
    const CameraModel model = next_model(i);
    const Disc disc = next_disc(model, 0.01);
    ImageEllipse front;
    ImageEllipse back;
    if (project_disc(model, disc.centre, disc.normal, 0.05, front) != OpticsStatus::ok) continue;
    ASSERT_EQ(project_disc(model, disc.centre, -disc.normal, 0.05, back), OpticsStatus::ok);
    EXPECT_EQ(front.semi_major_px, back.semi_major_px);
    EXPECT_EQ(front.semi_minor_px, back.semi_minor_px);
    EXPECT_EQ(front.angle_rad, back.angle_rad);
    EXPECT_EQ(facing(model, disc.centre, disc.normal), -facing(model, disc.centre, -disc.normal));
  }
}

Cahv straight_camera() {
  Cahv camera;  // at the origin, looking along z
  camera.h = {500.0, 0.0, 320.0};
  camera.v = {0.0, 500.0, 240.0};
  return camera;
}

TEST_F(ProjectedCircle, KnowsTheSimplestDiscs) {
  const CameraModel model = straight_camera();
  const Vector3d place(0.0, 0.0, 5.0);
  ImageEllipse ellipse;
  ASSERT_EQ(project_disc(model, place, -Vector3d::UnitZ(), 0.05, ellipse), OpticsStatus::ok);
  EXPECT_NEAR(ellipse.semi_major_px, 5.0, 1e-12);
  EXPECT_NEAR(ellipse.semi_minor_px, 5.0, 1e-12);
  const Vector3d tilted =
      -Eigen::AngleAxisd(kPi / 3.0, Vector3d::UnitX()).toRotationMatrix().col(2);
  ASSERT_EQ(project_disc(model, place, tilted, 0.05, ellipse), OpticsStatus::ok);
  EXPECT_NEAR(ellipse.semi_major_px, 5.0, 1e-12);
  EXPECT_NEAR(ellipse.semi_minor_px, 2.5, 1e-12);
  EXPECT_NEAR(ellipse.angle_rad, 0.0, 1e-12);
  EXPECT_NEAR(facing(model, place, tilted), 0.5, 1e-12);
  ASSERT_EQ(project_disc(model, place, Vector3d::UnitX(), 0.05, ellipse), OpticsStatus::ok);
  EXPECT_NEAR(ellipse.semi_minor_px, 0.0, 1e-7);  // edge on
  EXPECT_NEAR(ellipse.angle_rad, kPi / 2.0, 1e-12);
}

TEST_F(ProjectedCircle, TellsWhatTheCameraCannotSee) {
  const CameraModel model = straight_camera();
  ImageEllipse ellipse{1.0, 2.0, 3.0};
  EXPECT_EQ(project_disc(model, {0.0, 0.0, -5.0}, Vector3d::UnitZ(), 0.05, ellipse),
            OpticsStatus::behind);
  EXPECT_EQ(ellipse.semi_major_px, 1.0);
  EXPECT_EQ(facing(model, Vector3d::Zero(), Vector3d::UnitZ()), 0.0);
}

}  // namespace
}  // namespace dottrack::geometry
