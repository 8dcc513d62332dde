// The ground, and the light on it.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "host_sim/world/hall_lamps.h"
#include "host_sim/world/terrain.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(TerrainTest, HasDunesAndHollowsButNoneAtTheBoards) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Terrain terrain(22.0, 9.0, seed);
    double low = 0.0;
    double high = 0.0;
    for (double x = -10.9; x < 11.0; x += 0.1) {
      for (double y = -4.4; y < 4.5; y += 0.1) {
        low = std::min(low, terrain.height_m({x, y}));
        high = std::max(high, terrain.height_m({x, y}));
      }
      EXPECT_EQ(terrain.height_m({x, 4.5}), 0.0);
      EXPECT_EQ(terrain.height_m({x, -4.6}), 0.0);
    }
    EXPECT_GT(low, -0.12);
    EXPECT_LT(low, -0.05);
    EXPECT_LT(high, 0.12);
    EXPECT_GT(high, 0.05);
  }
}

TEST(TerrainTest, NormalsAreThoseOfTheHeights) {
  const Terrain terrain(22.0, 9.0, 3, Ramp{{2.0, 1.0}, 0.7});
  double steepest = 1.0;
  for (double x = -10.0; x < 10.0; x += 0.37) {
    for (double y = -4.0; y < 4.0; y += 0.41) {
      const Vector2d p(x, y);
      const Vector3d n = terrain.normal(p);
      const double d = 0.003;
      const Vector3d along_x(2.0 * d, 0.0,
                             terrain.sand_height_m(p + Vector2d(d, 0.0)) -
                                 terrain.sand_height_m(p - Vector2d(d, 0.0)));
      const Vector3d along_y(0.0, 2.0 * d,
                             terrain.sand_height_m(p + Vector2d(0.0, d)) -
                                 terrain.sand_height_m(p - Vector2d(0.0, d)));
      EXPECT_NEAR(n.norm(), 1.0, 1e-12);
      if (terrain.height_m(p) != terrain.sand_height_m(p)) continue;
      if (terrain.in_ramp(p).norm() < 4.5) continue;  // the ramp's sides
      EXPECT_NEAR(n.dot(along_x) / along_x.norm(), 0.0, 2e-3);
      EXPECT_NEAR(n.dot(along_y) / along_y.norm(), 0.0, 2e-3);
      steepest = std::min(steepest, n.z());
    }
  }
  EXPECT_LT(steepest, std::cos(radians(5.0)));
  EXPECT_GT(steepest, std::cos(radians(16.0)));
}

TEST(TerrainTest, ARampRisesAsSteeplyAsItIsToldAndOnlyWhereItIs) {
  const Ramp ramp{{2.0, 1.0}, 0.7, radians(25.0), 3.0, 2.0};
  const Terrain terrain(22.0, 9.0, 3, ramp);
  const Vector2d forward(cosine(0.7), sine(0.7));
  const Vector2d left(-forward.y(), forward.x());
  const auto at = [&](double along, double aside) {
    return Vector2d(ramp.foot_m + along * forward + aside * left);
  };
  const Vector3d n = terrain.normal(at(1.5, 0.4));
  EXPECT_NEAR(n.z(), cosine(ramp.angle_rad), 1e-9);
  EXPECT_NEAR(-n.head<2>().dot(forward), sine(ramp.angle_rad), 1e-9);
  EXPECT_NEAR(terrain.height_m(at(1.5, -0.9)), 1.5 * tangent(ramp.angle_rad), 1e-9);
  EXPECT_NEAR(terrain.height_m(at(1.5, 1.05)), 0.0, 1e-3);  // beside it the sand is flat
  EXPECT_NEAR(terrain.height_m(at(2.8, 0.0)), 0.0, 1e-3);   // behind its upper end too
  EXPECT_NEAR(terrain.height_m(at(-0.2, 0.0)), 0.0, 1e-12);
}

struct Extremes {
  double low = 1e9;
  double high = 0.0;
};

Extremes on_floor(const std::vector<Lamp>& lamps, const char* group) {
  Extremes extremes;
  for (double x = -11.0; x <= 11.0; x += 0.5) {
    for (double y = -4.5; y <= 4.5; y += 0.5) {
      const double radiance = white_radiance(lamps, group, {x, y, 0.0}, Vector3d::UnitZ());
      extremes.low = std::min(extremes.low, radiance);
      extremes.high = std::max(extremes.high, radiance);
    }
  }
  return extremes;
}

TEST(HallLampsTest, GiveTheFloorTheLightThatIsPromised) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const std::vector<Lamp> lamps = hall_lamps(22.0, 9.0, 6.0, seed);
    const Extremes tubes = on_floor(lamps, "fluorescent");
    EXPECT_NEAR(tubes.low, 0.46, 0.03) << seed;
    EXPECT_NEAR(tubes.high, 0.72, 0.04) << seed;
    const Extremes sun = on_floor(lamps, "sun");
    EXPECT_NEAR(sun.low, 1.01, 0.02) << seed;
    EXPECT_NEAR(sun.high, 1.29, 0.02) << seed;
    EXPECT_LT(on_floor(lamps, "window").high, 0.1) << seed;
  }
}

TEST(HallLampsTest, AreInTwoGroupsOfFiveASunAndAWindow) {
  const std::vector<Lamp> lamps = hall_lamps(22.0, 9.0, 6.0, 2);
  ASSERT_EQ(lamps.size(), 12U);
  const auto count = [&](const char* group) {
    return std::count_if(lamps.begin(), lamps.end(),
                         [&](const Lamp& lamp) { return lamp.group == group; });
  };
  EXPECT_EQ(count("fluorescent_west"), 5);
  EXPECT_EQ(count("fluorescent_east"), 5);
  EXPECT_EQ(count("sun"), 1);
  EXPECT_EQ(count("window"), 1);
  for (const Lamp& lamp : lamps) {
    const Vector3d shines = lamp.half_u_m.cross(lamp.half_v_m).normalized();
    const Vector3d to_middle = (Vector3d(0.0, 0.0, 0.5) - lamp.position_m).normalized();
    EXPECT_GT(shines.dot(to_middle), 0.3) << lamp.group;
  }
}

}  // namespace
}  // namespace dottrack::host_sim
