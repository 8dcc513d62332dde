#include "host_sim/scenarios/placements.h"

#include <gtest/gtest.h>

#include <set>

#include "host_sim/scenarios/body_scenes.h"
#include "host_sim/scenarios/dot_light.h"
#include "host_sim/scenarios/scenario_file.h"
#include "host_sim/scenarios/visibility.h"
#include "host_sim/world/meshes.h"
#include "host_sim/world/motions.h"

namespace dottrack::host_sim {
namespace {

class Placements : public testing::Test {
 protected:
  Placement placement(std::uint64_t index, std::uint64_t seed = 1) const {
    return random_placement(scene_, hall_.scene, seed, index);
  }

  Scene scene_ = *load_scenario(*find_scenario("drive"));
  Hall hall_{scene_.world.hall, scene_.world.lamps};
};

TEST_F(Placements, AreAFunctionOfSeedAndIndex) {
  EXPECT_EQ(placement(3).vehicle->position_m, placement(3).vehicle->position_m);
  EXPECT_EQ(placement(3).bodies.size(), placement(3).bodies.size());
  EXPECT_NE(placement(3).vehicle->position_m, placement(4).vehicle->position_m);
  EXPECT_NE(placement(3).vehicle->position_m, placement(3, 2).vehicle->position_m);
}

TEST_F(Placements, AreAllOverTheSandboxInAllHeadings) {
  std::set<std::pair<int, int>> cells;
  std::set<int> octants;
  bool sun = false;
  bool no_sun = false;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Placement made = placement(i);
    const Eigen::Vector3d& p = made.vehicle->position_m;
    ASSERT_LT(std::abs(p.x()), 11.0);
    ASSERT_LT(std::abs(p.y()), 4.5);
    EXPECT_GT(made.vehicle->rotation(2, 2), 0.9) << "it stands";
    cells.insert({static_cast<int>(p.x() + 11.0) / 4, static_cast<int>(p.y() + 4.5) / 3});
    octants.insert(static_cast<int>(
        4.0 *
        (1.0 + std::atan2(made.vehicle->rotation(1, 0), made.vehicle->rotation(0, 0)) / 3.1416)));
    (made.light.level("sun", 0.0) > 0.0 ? sun : no_sun) = true;
    EXPECT_GE(made.light.level("fluorescent_east", 0.0), 0.5);
    EXPECT_GT(made.opening, 0.2);
    EXPECT_LE(made.opening, 1.0);
  }
  EXPECT_GE(cells.size(), 14U) << "of 18";
  EXPECT_EQ(octants.size(), 8U);
  EXPECT_TRUE(sun && no_sun);
}

// The lander is 1.5 m high and more: a rover inside it would have its deck hidden from everywhere.
TEST_F(Placements, MostHaveDotsInTwoViewsAndThingsAround) {
  int lockable = 0;
  std::size_t things = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Placement made = placement(i);
    const BodyScenes bodies(made.bodies);
    const auto views =
        views_of_dots(scene_.cameras, scene_.target, *made.vehicle, hall_, bodies.moving(), 0.0);
    if (dots_in_two_views(views) >= 3) ++lockable;
    things += made.bodies.size() - 1;
  }
  EXPECT_GE(lockable, 93);
  EXPECT_GT(things, 300U);
  EXPECT_LT(things, 900U);
}

TEST_F(Placements, WithoutAVehicleAreTheSameThingsAroundNothing) {
  const Placement with = placement(3);
  scene_.vehicle.reset();
  const Placement without = placement(3);
  EXPECT_FALSE(without.vehicle);
  EXPECT_EQ(without.bodies.size() + 1, with.bodies.size());
}

TEST_F(Placements, ADotIsSeenUntilSomethingStandsBeforeIt) {
  const Pose vehicle = *truth(scene_, 0.0);
  const auto free = views_of_dots(scene_.cameras, scene_.target, vehicle, hall_, {}, 0.0);
  ASSERT_EQ(free.size(), 5U);
  EXPECT_EQ(dots_in_two_views(free), 5);
  Pose upside_down = vehicle;
  upside_down.rotation.col(1) *= -1.0;
  upside_down.rotation.col(2) *= -1.0;
  upside_down.position_m.z() += 2.0;
  EXPECT_EQ(
      dots_in_two_views(views_of_dots(scene_.cameras, scene_.target, upside_down, hall_, {}, 0.0)),
      0);
}

TEST_F(Placements, ADotIsWellLitUntilAShadowsEdgeIsOnItOrItIsDark) {
  const Pose vehicle = *truth(scene_, 0.0);
  const LightPlan lit;
  const auto open = light_on_dots(scene_.target, vehicle, hall_, {}, lit, 0.0);
  ASSERT_EQ(open.size(), 5U);
  for (const DotLight& dot : open) {
    EXPECT_GT(dot.darkest, 0.0);
    EXPECT_LE(dot.darkest, dot.brightest);
    EXPECT_TRUE(well_lit(dot, scene_, 1.0));
    EXPECT_FALSE(well_lit(dot, scene_, 0.02)) << "irises nearly shut";
  }
  EXPECT_FALSE(well_lit({0.3, 0.6}, scene_, 1.0)) << "cut in two";
  EXPECT_TRUE(well_lit({0.5, 0.6}, scene_, 1.0));
  LightPlan dark;
  for (const char* group : {"fluorescent", "window", "sun"})
    dark.changes.push_back({group, 0, 0, 0});
  for (const DotLight& dot : light_on_dots(scene_.target, vehicle, hall_, {}, dark, 0.0)) {
    EXPECT_EQ(dot.brightest, 0.0);
  }
  // A roof a little above the first dot.
  Body roof{"roof", {}, stand_at(vehicle)};
  const Eigen::Vector3d above = scene_.target[0].centre_m + Eigen::Vector3d(0.0, 0.0, 0.05);
  add(roof.model, box(above, {0.6, 0.6, 0.01}), {.albedo = 0.5});
  const std::vector<Body> roofs{roof};
  const BodyScenes shade(roofs);
  const auto under = light_on_dots(scene_.target, vehicle, hall_, shade.moving(), lit, 0.0);
  EXPECT_LT(under[0].brightest, 0.5 * open[0].darkest);
  EXPECT_EQ(under[1].darkest, open[1].darkest);
}

}  // namespace
}  // namespace dottrack::host_sim
