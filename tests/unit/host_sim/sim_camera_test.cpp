#include "host_sim/renderer/sim_camera.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "host_sim/world/random.h"
#include "tests/support/shared_data.h"
#include "tests/unit/geometry/table.h"
#include "tests/unit/host_sim/cahvor_numbers.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The published equations, evaluated in 113-bit floating point for this model, are the reference.
// Its A, H, V and O carry nine decimals, so they are unit or orthogonal to about 1e-9 only: the
// reason for 1e-6 px here.
const test::CahvorNumbers kCeilingWide{{4.6, 0.25, 5.05},
                                       {0.086444922, 0.51002504, -0.855804729},
                                       {428.925862975, 151.741174978, -253.246717427},
                                       {19.571130361, -227.794866169, -398.325984344},
                                       {0.097380811, 0.516379738, -0.85080488},
                                       {0.0009, -0.1854, 0.0412}};
constexpr double kPixelTolerance = 1e-6;
constexpr double kDirectionTolerance = 1e-8;

struct Row {
  Vector3d point;
  Vector2d pixel;
};

const std::array<Row, 3> kProjections = {{
    {{0.892791, 4.857735, 2.746153}, {-1.799856435895484e-05, -1.3978676992054003e-05}},
    {{6.108459, 6.383708, -0.436239}, {372.4027366155981, 104.84572581621197}},
    {{4.427964, 0.440793, 2.161618}, {272.24478439774356, 421.3518480846899}},
}};
const std::array<Row, 3> kRays = {{
    {{-0.584103431156322, 0.7259892589231411, -0.3629914291545189}, {0.0, 0.0}},
    {{0.6473880376683736, -0.12519809829584352, -0.7518072657716184}, {639.0, 479.0}},
    {{-0.5842205830398349, 0.3681726872459704, -0.7232808463651421},
     {26.169034155716187, 251.1889627668228}},
}};

SimCamera ceiling_wide() {
  return test::sim_camera(kCeilingWide, 640, 480);
}

TEST(SimCameraTest, ProjectsAsTheReferenceRows) {
  for (const Row& row : kProjections) {
    const auto pixel = ceiling_wide().project(row.point);
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - row.pixel).norm(), kPixelTolerance);
  }
}

TEST(SimCameraTest, SeesAlongTheReferenceRays) {
  for (const Row& row : kRays) {
    const auto direction = ceiling_wide().direction(row.pixel);
    ASSERT_TRUE(direction);
    EXPECT_LT((direction->normalized() - row.point).norm(), kDirectionTolerance);
  }
}

TEST(SimCameraTest, AgreesWithAllSharedProjections) {
  const auto shared = test::shared_data();
  if (!shared) GTEST_SKIP() << "shared data absent: camera_models";
  const auto table = test::Table::read(*shared / "camera_models/cahvor_ceiling_wide_3d2d.csv");
  ASSERT_GE(table.size(), 400U);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto pixel =
        ceiling_wide().project({table.number(i, "X"), table.number(i, "Y"), table.number(i, "Z")});
    ASSERT_TRUE(pixel) << "row " << i;
    const Vector2d expected(table.number(i, "ref_x"), table.number(i, "ref_y"));
    EXPECT_LT((*pixel - expected).norm(), kPixelTolerance) << "row " << i;
  }
}

TEST(SimCameraTest, AgreesWithAllSharedRays) {
  const auto shared = test::shared_data();
  if (!shared) GTEST_SKIP() << "shared data absent: camera_models";
  const auto table = test::Table::read(*shared / "camera_models/cahvor_ceiling_wide_2d3d.csv");
  ASSERT_GE(table.size(), 400U);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto direction = ceiling_wide().direction({table.number(i, "x"), table.number(i, "y")});
    ASSERT_TRUE(direction) << "row " << i;
    const Vector3d expected(table.number(i, "ref_ux"), table.number(i, "ref_uy"),
                            table.number(i, "ref_uz"));
    EXPECT_LT((direction->normalized() - expected).norm(), kDirectionTolerance) << "row " << i;
  }
}

TEST(SimCameraTest, ComesBackToThePixel) {
  const SimCamera camera = ceiling_wide();
  RandomStream random(1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Vector2d pixel(random.uniform(-0.5, 639.5), random.uniform(-0.5, 479.5));
    const auto direction = camera.direction(pixel);
    ASSERT_TRUE(direction);
    const auto back = camera.project(camera.centre_m() + random.uniform(0.5, 20.0) * *direction);
    ASSERT_TRUE(back);
    EXPECT_LT((*back - pixel).norm(), 1e-9);
  }
}

TEST(SimCameraTest, RefusesPointsBehindIt) {
  const SimCamera camera = ceiling_wide();
  const Vector3d behind = camera.centre_m() - 2.0 * camera.rotation().row(2).transpose();
  EXPECT_FALSE(camera.project(behind));
  EXPECT_FALSE(camera.project(camera.centre_m()));
}

TEST(SimCameraTest, EndsWhereTheDistortionFoldsOver) {
  Lens lens;
  lens.radial = {0.0, -0.2, 0.0};  // slope 1 - 0.6 t^2 vanishes at t = 1.29
  const SimCamera camera(Vector3d::Zero(), Eigen::Matrix3d::Identity(), lens, 640, 480);
  EXPECT_NEAR(camera.max_tangent(), std::sqrt(1.0 / 0.6), 1e-12);
  EXPECT_TRUE(camera.project({1.28, 0.0, 1.0}));
  EXPECT_FALSE(camera.project({1.30, 0.0, 1.0}));
  const double furthest = 1.2909944487358056 * (1.0 - 0.2 / 0.6) * lens.focal_x_px;
  EXPECT_TRUE(camera.direction({lens.centre_x_px + furthest - 0.1, lens.centre_y_px}));
  EXPECT_FALSE(camera.direction({lens.centre_x_px + furthest + 0.1, lens.centre_y_px}));
}

TEST(SimCameraTest, LooksWhereItIsTold) {
  const Vector3d centre(3.0, -2.0, 5.0);
  const Vector3d aim(0.2, 0.4, 0.1);
  const SimCamera camera(centre, looking_at(centre, aim, 0.3), {}, 640, 480);
  const auto pixel = camera.project(aim);
  ASSERT_TRUE(pixel);
  EXPECT_LT((*pixel - Vector2d(319.5, 239.5)).norm(), 1e-9);
  EXPECT_NEAR(camera.rotation().determinant(), 1.0, 1e-12);
  const SimCamera level(centre, looking_at(centre, aim, 0.0), {}, 640, 480);
  EXPECT_LT(level.project(aim + Vector3d(0.0, 0.0, 0.1))->y(), 239.5);  // up is up
}

}  // namespace
}  // namespace dottrack::host_sim
