// What a world is made of: arithmetic, random numbers, shapes, motion, target layouts.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "host_sim/scenarios/scenes.h"
#include "host_sim/world/drive_path.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"
#include "host_sim/world/shapes.h"
#include "host_sim/world/target_layout.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

TEST(PortableMathTest, AgreesWithTheLibrary) {
  for (double x = -40.0; x < 40.0; x += 0.0137) {
    EXPECT_NEAR(sine(x), std::sin(x), 2e-15) << x;
    EXPECT_NEAR(cosine(x), std::cos(x), 2e-15) << x;
    EXPECT_NEAR(exponential(x) / std::exp(x), 1.0, 2e-15) << x;
  }
  EXPECT_NEAR(tangent(0.6), std::tan(0.6), 1e-15);
}

// The first numbers of a stream never change: scenes depend on them.
TEST(RandomStreamTest, IsAFixedSequence) {
  RandomStream random(1, 2);
  EXPECT_EQ(random.word(), 8460352000482166300ULL);
  RandomStream other(2, 2);
  EXPECT_NE(RandomStream(1, 2).word(), other.word());
}

TEST(RandomStreamTest, NoiseHasMeanZeroAndVarianceOne) {
  constexpr int kCount = 200000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const auto n = static_cast<std::uint64_t>(i);
    const double value = nearly_normal(mix(7, 2 * n), mix(7, 2 * n + 1));
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.01);
  EXPECT_NEAR(squares / kCount, 1.0, 0.015);
}

struct Meeting {
  Shape shape;
  double distance;
  Vector3d normal;
};

TEST(ShapesTest, LinesMeetThemWhereGeometrySays) {
  const Line down{{0.1, 0.05, 5.0}, {0.0, 0.0, -2.0}};
  const std::vector<Meeting> meetings = {
      {Disc{{0.0, 0.0, 1.0}, Vector3d::UnitZ(), 0.2}, 2.0, Vector3d::UnitZ()},
      {Disc{{0.0, 0.0, 1.0}, -Vector3d::UnitZ(), 0.2}, 2.0, Vector3d::UnitZ()},
      {make_outline({0, 0, 2}, Vector3d::UnitX(), Vector3d::UnitY(), {{-1, -1}, {1, -1}, {0, 1}}),
       1.5, Vector3d::UnitZ()},
      {make_box({{0.0, 0.0, 0.5}, Eigen::Matrix3d::Identity()}, {1.0, 1.0, 1.0}), 2.0,
       Vector3d::UnitZ()},
      {Cylinder{{-1.0, 0.05, 0.0}, Vector3d::UnitX(), 2.0, 0.5}, 2.25, Vector3d::UnitZ()},
      {Cylinder{{0.0, 0.0, 0.0}, Vector3d::UnitZ(), 3.0, 0.5}, 1.0, Vector3d::UnitZ()},
      {Ball{{0.1, 0.05, 0.0}, 1.0}, 2.0, Vector3d::UnitZ()},
  };
  for (const Meeting& m : meetings) {
    Hit hit;
    ASSERT_TRUE(intersect(m.shape, down, hit)) << m.shape.index();
    EXPECT_NEAR(hit.distance, m.distance, 1e-12) << m.shape.index();
    EXPECT_LT((hit.normal - m.normal).norm(), 1e-9) << m.shape.index();
    const Vector3d p = down.origin + hit.distance * down.direction;
    const Ball bound = bounding_ball(m.shape);
    EXPECT_LE((p - bound.centre).norm(), bound.radius_m * (1.0 + 1e-9)) << m.shape.index();
  }
}

TEST(ShapesTest, LinesMissWhatIsBesideOrBehindThem) {
  const Line beside{{3.0, 0.0, 5.0}, {0.0, 0.0, -1.0}};
  const Line upwards{{0.0, 0.0, 5.0}, {0.0, 0.0, 1.0}};
  const std::vector<Shape> shapes = {
      Disc{{0.0, 0.0, 1.0}, Vector3d::UnitZ(), 0.2},
      make_outline({0, 0, 2}, Vector3d::UnitX(), Vector3d::UnitY(), {{-1, -1}, {1, -1}, {0, 1}}),
      make_box({{0.0, 0.0, 0.5}, Eigen::Matrix3d::Identity()}, {1.0, 1.0, 1.0}),
      Cylinder{{0.0, 0.0, 0.0}, Vector3d::UnitZ(), 3.0, 0.5}, Ball{{0.0, 0.0, 0.0}, 1.0}};
  Hit hit;
  for (const Shape& shape : shapes) {
    EXPECT_FALSE(intersect(shape, beside, hit)) << shape.index();
    EXPECT_FALSE(intersect(shape, upwards, hit)) << shape.index();
  }
}

TEST(ShapesTest, AnOutlineMayHaveABay) {
  const std::vector<Eigen::Vector2d> horseshoe = {{0, 0}, {3, 0}, {3, 3}, {2, 3},
                                                  {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  EXPECT_TRUE(inside_outline(horseshoe, {0.5, 2.0}));
  EXPECT_TRUE(inside_outline(horseshoe, {2.5, 2.0}));
  EXPECT_FALSE(inside_outline(horseshoe, {1.5, 2.0}));
  EXPECT_FALSE(inside_outline(horseshoe, {4.0, 2.0}));
}

TEST(DrivePathTest, StartsWhereAndAsItIsTold) {
  const DrivePath path = starting_at({}, {1.2, -0.7}, 2.1);
  const Pose pose = pose_at(path, 0.0);
  EXPECT_NEAR(pose.position_m.x(), 1.2, 1e-12);
  EXPECT_NEAR(pose.position_m.y(), -0.7, 1e-12);
  const Vector3d forward = pose.rotation.col(0);
  EXPECT_NEAR(std::atan2(forward.y(), forward.x()), 2.1, 1e-9);
}

TEST(DrivePathTest, DrivesForwardAtAWalkersPaceAndStaysUpright) {
  const Scene scene = make_demo_scene(1);
  for (std::uint64_t tick = 0; tick < 900; ++tick) {
    const Pose a = truth(scene, tick);
    const Pose b = truth(scene, tick + 1);
    const Vector3d step = b.position_m - a.position_m;
    const double speed_m_s = step.norm() * scene.frame_rate_hz;
    EXPECT_GT(speed_m_s, 0.15) << tick;
    EXPECT_LT(speed_m_s, 0.7) << tick;
    EXPECT_GT(step.normalized().dot(a.rotation.col(0)), 0.97) << tick;
    EXPECT_GT(a.rotation(2, 2), 0.99) << tick;
    EXPECT_LT((a.rotation * a.rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    for (const TargetDot& dot : scene.target) {
      const Vector3d moved = b.to_world(dot.centre_m) - a.to_world(dot.centre_m);
      EXPECT_LT(moved.norm(), 1.5 * 0.5 * dot.diameter_m) << tick;  // the tracker's window
    }
  }
}

TEST(TargetLayoutTest, TheDemosIsUnlikeItself) {
  EXPECT_GT(distinctness_m(demo_layout()), 0.05);
}

TEST(TargetLayoutTest, ASymmetricalOneIsFoundOut) {
  TargetLayout square;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) square.push_back({{x, y, 0.5}, 0.1, Vector3d::UnitZ()});
  }
  EXPECT_LT(distinctness_m(square), 1e-12);
}

TEST(TargetLayoutTest, RandomOnesHaveAllTheirDotsApartAndAreUnlikeThemselves) {
  for (int dots = 3; dots <= 16; ++dots) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const TargetLayout layout = random_layout(dots, seed);
      ASSERT_EQ(layout.size(), static_cast<std::size_t>(dots)) << seed;
      EXPECT_GE(distinctness_m(layout), 0.03) << dots << " dots, seed " << seed;
      for (std::size_t i = 0; i < layout.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          EXPECT_GT((layout[i].centre_m - layout[j].centre_m).norm(), 1.5 * layout[i].diameter_m);
        }
      }
    }
  }
}

}  // namespace
}  // namespace dottrack::host_sim
