#include "host_sim/renderer/sim_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "host_sim/renderer/ray_lattice.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"
#include "tests/support/shared_data.h"
#include "tests/unit/geometry/reference_rows.h"
#include "tests/unit/geometry/table.h"
#include "tests/unit/host_sim/jpl_camera.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The published equations, evaluated in 113-bit floating point, are the reference. They take the
// axis O as it stands in the file; here it is unit. So the digits of the file set how close the two
// can be: nine digits 1e-6 px, the six of the rover's fish-eye 1e-3 px.
struct Case {
  const char* name;
  int width_px;
  int height_px;
  double pixel_tolerance;
  double direction_tolerance;
};
constexpr Case kCases[] = {{"cahv_ceiling_down", 640, 480, 1e-9, 1e-12},
                           {"cahvor_ceiling_wide", 640, 480, 1e-6, 1e-9},
                           {"cahvor_mer1_navcam_left", 1024, 1024, 1e-6, 1e-9},
                           {"cahvore_ceiling_fisheye", 640, 480, 1e-6, 1e-9},
                           {"cahvore_mer1_fhaz_left", 1024, 1024, 1e-3, 3e-6}};

const test::ReferenceCamera& reference(const std::string& name) {
  for (const auto& camera : test::kReferenceCameras) {
    if (name == camera.name) return camera;
  }
  throw std::invalid_argument(name);
}

SimCamera camera_of(const Case& tested) {
  return test::sim_camera(reference(tested.name).model, tested.width_px, tested.height_px);
}

class SimCameraReferenceTest : public testing::TestWithParam<Case> {
 protected:
  void expect_projection(const Vector3d& point, const Vector2d& expected) const {
    const auto pixel = camera_.project(point);
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - expected).norm(), GetParam().pixel_tolerance);
  }
  void expect_sight(const Vector2d& pixel, const Vector3d& origin,
                    const Vector3d& direction) const {
    const auto sight = camera_.sight(pixel);
    ASSERT_TRUE(sight);
    EXPECT_LT((sight->direction.normalized() - direction).norm(), GetParam().direction_tolerance);
    EXPECT_LT((sight->origin - origin).norm(), GetParam().direction_tolerance);
  }

  const SimCamera camera_ = camera_of(GetParam());
};

TEST_P(SimCameraReferenceTest, AgreesWithTheRowsHere) {
  const test::ReferenceCamera& camera = reference(GetParam().name);
  for (const auto& row : camera.projections) {
    expect_projection(Vector3d(row.point.data()), Vector2d(row.pixel.data()));
  }
  for (const auto& row : camera.rays) {
    expect_sight(Vector2d(row.pixel.data()), Vector3d(row.origin.data()),
                 Vector3d(row.direction.data()));
  }
}

TEST_P(SimCameraReferenceTest, AgreesWithAllSharedRows) {
  const auto shared = test::shared_data();
  if (!shared) GTEST_SKIP() << "shared data absent: camera_models";
  const auto folder = *shared / "camera_models";
  const auto points = test::Table::read(folder / (std::string(GetParam().name) + "_3d2d.csv"));
  const auto pixels = test::Table::read(folder / (std::string(GetParam().name) + "_2d3d.csv"));
  ASSERT_EQ(points.size(), 400U);
  ASSERT_EQ(pixels.size(), 400U);
  const auto vector = [](const test::Table& table, std::size_t i, const std::string& prefix) {
    return Vector3d{table.number(i, prefix + "x"), table.number(i, prefix + "y"),
                    table.number(i, prefix + "z")};
  };
  for (std::size_t i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    expect_projection({points.number(i, "X"), points.number(i, "Y"), points.number(i, "Z")},
                      {points.number(i, "ref_x"), points.number(i, "ref_y")});
    expect_sight({pixels.number(i, "x"), pixels.number(i, "y")}, vector(pixels, i, "ref_o"),
                 vector(pixels, i, "ref_u"));
  }
}

TEST_P(SimCameraReferenceTest, ComesBackToThePixel) {
  RandomStream random(1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Vector2d pixel{random.uniform(-0.5, GetParam().width_px - 0.5),
                         random.uniform(-0.5, GetParam().height_px - 0.5)};
    const auto sight = camera_.sight(pixel);
    ASSERT_TRUE(sight);
    const double distance_m = random.uniform(0.1, 20.0);
    const auto back = camera_.project(sight->origin + distance_m * sight->direction.normalized());
    ASSERT_TRUE(back);
    EXPECT_LT((*back - pixel).norm(), 1e-9);
  }
}

// Measured: 0.00042 px in the fish-eye under the ceiling, 0.0017 in the corners of the rover's.
TEST_P(SimCameraReferenceTest, ALatticeOfSightsIsNearlyTheLens) {
  const RayLattice lattice(camera_);
  RandomStream random(2, 2);
  for (int i = 0; i < 3000; ++i) {
    const int x = static_cast<int>(random.uniform(0.0, GetParam().width_px));
    const int y = static_cast<int>(random.uniform(0.0, GetParam().height_px));
    const Vector2d place{random.uniform(), random.uniform()};
    ASSERT_TRUE(lattice.seen(x, y));
    const Sight sight = lattice.inside(x, y, place.x(), place.y());
    const auto pixel = camera_.project(sight.origin + 3.0 * sight.direction);
    ASSERT_TRUE(pixel);
    const Vector2d expected = Vector2d(x - 0.5, y - 0.5) + place;
    EXPECT_LT((*pixel - expected).norm(), GetParam().width_px == 640 ? 0.0005 : 0.002);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, SimCameraReferenceTest, testing::ValuesIn(kCases),
                         [](const auto& tested) { return std::string(tested.param.name); });

SimCamera at_origin(const Lens& lens) {
  return {Vector3d::Zero(), Eigen::Matrix3d::Identity(), lens, 640, 480};
}

TEST(SimCameraTest, RefusesPointsBehindIt) {
  for (const LensKind kind : {LensKind::pinhole, LensKind::radial}) {
    Lens lens;
    lens.kind = kind;
    EXPECT_FALSE(at_origin(lens).project({0.1, 0.0, -2.0}));
    EXPECT_FALSE(at_origin(lens).project({0.1, 0.0, 0.0}));
    EXPECT_FALSE(at_origin(lens).project(Vector3d::Zero()));
  }
}

TEST(SimCameraTest, AFishEyeSeesBehindItselfButNotEverywhere) {
  Lens lens;
  lens.kind = LensKind::fisheye;
  lens.focal_x_px = lens.focal_y_px = 130.0;
  lens.pupil_m = {0.003, -0.001, 0.0};
  const SimCamera camera = at_origin(lens);
  const double angle = radians(100.0);
  const auto pixel = camera.project({5.0 * sine(angle), 0.0, 5.0 * cosine(angle)});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), lens.centre_x_px + 130.0 * angle, 0.2);  // less the pupil's travel
  EXPECT_FALSE(camera.project({0.1, 0.0, -5.0}));
  EXPECT_FALSE(camera.project(Vector3d::Zero()));
  EXPECT_FALSE(camera.sight({lens.centre_x_px + 130.0 * 2.5, lens.centre_y_px}));
}

// A pupil that is well ahead of the centre is what a near point is seen from.
TEST(SimCameraTest, AMovingPupilIsWhereTheLightIsAimedAt) {
  Lens lens;
  lens.kind = LensKind::fisheye;
  lens.pupil_m = {0.02, 0.0, 0.0};
  const SimCamera camera = at_origin(lens);
  const double angle = 1.0;
  const Vector3d pupil(0.0, 0.0, 0.02 * (angle / std::sin(angle) - 1.0));
  const Vector3d light(0.0, std::sin(angle), std::cos(angle));
  for (const double distance_m : {0.05, 0.5, 5.0}) {
    const auto pixel = camera.project(pupil + distance_m * light);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->y(), lens.centre_y_px + lens.focal_y_px * angle, 1e-9);
    EXPECT_NEAR(pixel->x(), lens.centre_x_px, 1e-9);
  }
}

TEST(SimCameraTest, EndsWhereTheDistortionFoldsOver) {
  Lens lens;
  lens.radial = {0.0, -0.2, 0.0};  // slope 1 - 0.6 t^2 vanishes at t = 1.29
  const SimCamera camera = at_origin(lens);
  EXPECT_TRUE(camera.project({1.2909, 0.0, 1.0}));
  EXPECT_FALSE(camera.project({1.2911, 0.0, 1.0}));
  const double furthest = 1.2909944487358056 * (1.0 - 0.2 / 0.6) * lens.focal_x_px;
  EXPECT_TRUE(camera.sight({lens.centre_x_px + furthest - 0.1, lens.centre_y_px}));
  EXPECT_FALSE(camera.sight({lens.centre_x_px + furthest + 0.1, lens.centre_y_px}));
}

TEST(SimCameraTest, ALatticeSaysWhatTheLensDoesNotSee) {
  Lens lens;
  lens.focal_x_px = lens.focal_y_px = 300.0;
  lens.radial = {0.0, -0.2, 0.0};  // ends 258 px from the middle
  const RayLattice lattice(at_origin(lens));
  EXPECT_TRUE(lattice.seen(320, 240));
  EXPECT_TRUE(lattice.seen(320 + 250, 240));
  EXPECT_FALSE(lattice.seen(320 + 258, 240));
  EXPECT_FALSE(lattice.seen(0, 0));
  EXPECT_TRUE(lattice.corner(0, 0).direction.isZero(0.0));
}

TEST(SimCameraTest, APinholeHasNoDistortionWhateverItsNumbersSay) {
  Lens lens;
  lens.radial = {0.1, 0.2, 0.3};
  lens.kind = LensKind::pinhole;
  const auto pixel = at_origin(lens).project({0.5, -0.25, 1.0});
  ASSERT_TRUE(pixel);
  EXPECT_LT((*pixel - Vector2d(319.5 + 230.0, 239.5 - 115.0)).norm(), 1e-9);
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

TEST(SimCameraTest, TheArcTangentIsTheCLibrarys) {
  RandomStream random(3, 3);
  for (int i = 0; i < 20000; ++i) {
    const double angle = random.uniform(-kPi, kPi);
    const double size = exponential(random.uniform(-20.0, 20.0));
    const double y = size * std::sin(angle);
    const double x = size * std::cos(angle);
    EXPECT_NEAR(arc_tangent(y, x), std::atan2(y, x), 1e-15);
  }
  EXPECT_EQ(arc_tangent(0.0, 0.0), 0.0);
  EXPECT_EQ(arc_tangent(0.0, -1.0), kPi);
}

}  // namespace
}  // namespace dottrack::host_sim
