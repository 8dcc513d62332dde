// Whole things: the hall, the rover, people.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host_sim/world/hall.h"
#include "host_sim/world/hall_lamps.h"
#include "host_sim/world/look_alikes.h"
#include "host_sim/world/meshes.h"
#include "host_sim/world/motions.h"
#include "host_sim/world/person.h"
#include "host_sim/world/rover.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const WayPoints kRound = {{-7.0, -2.0}, {0.0, -2.5}, {7.0, -1.5},
                          {7.5, 2.0},   {0.0, 1.5},  {-6.0, 2.0}};

Model hall_of(std::uint64_t seed) {
  HallOptions options;
  options.seed = seed;
  options.distance_to_drive_m = [](const Vector2d& p) {
    return distance_to_path_m(kRound, true, p);
  };
  return make_hall(options, Terrain(22.0, 9.0, seed), hall_lamps(22.0, 9.0, 6.0, seed));
}

template <class Visit>
void for_each_corner(const Model& model, const Visit& visit) {
  for (const Part& part : model.parts) {
    const auto* mesh = std::get_if<TriangleMesh>(&part.solid);
    if (mesh == nullptr) continue;
    for (const auto& v : mesh->vertices) visit(Vector3d(v.cast<double>()));
  }
}

// Whether the point lies in a triangle of the mesh that faces along `normal`.
bool on_face(const TriangleMesh& mesh, const Vector3d& p, const Vector3d& normal) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
    std::array<Vector3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = mesh.vertices[triangle[i]].template cast<double>();
    const Vector3d n = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    if (n.dot(normal) < 1.0 - 1e-5 || std::abs(n.dot(p - corners[0])) > 5e-6) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d edge = corners[(i + 1) % 3] - corners[i];
      if (n.dot(edge.cross(p - corners[i])) < -1e-7) return false;
    }
    return true;
  });
}

// All of every mark lies on the part that it is painted on.
void expect_painted_on(const Model& model) {
  for (std::size_t i = 0; i < model.marks.size(); ++i) {
    const Mark& mark = model.marks[i];
    ASSERT_LT(mark.part, model.parts.size());
    const auto* mesh = std::get_if<TriangleMesh>(&model.parts[mark.part].solid);
    ASSERT_NE(mesh, nullptr);
    const Pose face = facing(mark.centre_m, mark.normal);
    for (int k = 0; k < 12; ++k) {
      const double angle = radians(30.0 * k);
      const Vector3d rim =
          face.to_world({mark.radius_m * cosine(angle), mark.radius_m * sine(angle), 0.0});
      EXPECT_TRUE(on_face(*mesh, rim, mark.normal)) << "mark " << i << ", rim " << k;
    }
  }
}

TEST(HallTest, IsFullOfThingsWithinItsBudget) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Model hall = hall_of(seed);
    EXPECT_GT(hall.parts.size(), 500U);
    EXPECT_LT(hall.parts.size(), 4000U);
    EXPECT_GT(triangle_count(hall), 80000U);
    EXPECT_LT(triangle_count(hall), 400000U);
    EXPECT_GT(hall.marks.size(), 30U);
    expect_painted_on(hall);
    for (const Part& part : hall.parts) {
      EXPECT_GT(part.material.albedo, 0.0);
      EXPECT_LE(part.material.albedo, 0.9);
    }
  }
}

TEST(HallTest, LeavesTheDriveTheCamerasAndTheSunFree) {
  const Terrain terrain(22.0, 9.0, 1);
  const double sun_slope = tangent(radians(35.0));
  for_each_corner(hall_of(1), [&](const Vector3d& p) {
    const bool over_sand = terrain.is_sand(p.head<2>());
    if (over_sand && p.z() > terrain.height_m(p.head<2>()) + 0.02 && p.z() < 2.5) {
      ASSERT_GT(distance_to_path_m(kRound, true, p.head<2>()), 0.95) << p.transpose();
    }
    ASSERT_FALSE(over_sand && p.z() > 2.5 && p.z() < 5.6) << p.transpose();
    const bool in_bay = p.x() > 11.2 && std::abs(p.y()) < 5.0 && p.z() < 5.5;
    ASSERT_FALSE(in_bay && p.z() > sun_slope * (p.x() - 9.0) + 0.1) << p.transpose();
  });
}

TEST(HallTest, IsTheSameTwiceAndAnotherWithAnotherSeed) {
  const Model one = hall_of(4);
  const Model same = hall_of(4);
  const Model other = hall_of(5);
  std::vector<Vector3d> a;
  std::vector<Vector3d> b;
  for_each_corner(one, [&](const Vector3d& p) { a.push_back(p); });
  for_each_corner(same, [&](const Vector3d& p) { b.push_back(p); });
  EXPECT_EQ(a, b);
  EXPECT_NE(one.parts.size(), other.parts.size());
}

TEST(HallTest, SaysWhereItsCalibrationDotsAre) {
  HallOptions options;
  options.calibration_dots = 30;
  const Terrain terrain(22.0, 9.0, 1);
  const Model hall = make_hall(options, terrain, {});
  const auto centres = calibration_dot_centres(options, terrain);
  ASSERT_EQ(centres.size(), 30U);
  ASSERT_GE(hall.marks.size(), 30U);
  double west = 0.0;
  double east = 0.0;
  double highest = 0.0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    EXPECT_EQ(hall.marks[i].centre_m, centres[i]);
    EXPECT_GE(hall.marks[i].radius_m, 0.10);
    EXPECT_LE(hall.marks[i].radius_m, 0.15);
    west = std::min(west, centres[i].x());
    east = std::max(east, centres[i].x());
    highest = std::max(highest, centres[i].z());
  }
  EXPECT_LT(west, -10.5);
  EXPECT_GT(east, 10.5);
  EXPECT_GT(highest, 2.0);
}

TEST(HallTest, ShinesWhereItsLampsAre) {
  const auto lamps = hall_lamps(22.0, 9.0, 6.0, 1);
  const Model hall = make_hall({}, Terrain(22.0, 9.0, 1), lamps);
  std::vector<int> shining;
  for (const Part& part : hall.parts) {
    if (part.material.emission > 0.0) shining.push_back(part.material.lamp);
  }
  std::vector<int> wanted;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    if (lamps[i].group != "sun") wanted.push_back(static_cast<int>(i));
  }
  EXPECT_EQ(shining, wanted);
}

TEST(HallTest, MayBeSmallAndHaveARamp) {
  HallOptions options;
  options.length_m = 9.0;
  options.width_m = 7.0;
  options.rocks = 10;
  Ramp ramp;
  ramp.foot_m = {-1.5, 0.0};
  const Terrain terrain(9.0, 7.0, 1, ramp);
  const Model hall = make_hall(options, terrain, hall_lamps(9.0, 7.0, 6.0, 1));
  double on_ramp = 0.0;
  for_each_corner(hall, [&](const Vector3d& p) {
    const Vector2d q = terrain.in_ramp(p.head<2>());
    if (q.x() < -0.1 || q.x() > 3.7 || std::abs(q.y()) > 0.95 || p.z() > 3.0) return;
    ASSERT_LE(p.z(), terrain.ramp_height_m(q.x()) + 1e-6) << p.transpose();  // nothing on it
    on_ramp = std::max(on_ramp, p.z());
  });
  for_each_corner(hall, [&](const Vector3d& p) {
    const Vector2d q = terrain.in_ramp(p.head<2>());
    if (std::abs(q.y()) < 1.01 && std::abs(q.x() - ramp.length_m * cosine(ramp.angle_rad)) < 1e-4) {
      on_ramp = std::max(on_ramp, p.z());
    }
  });
  EXPECT_NEAR(on_ramp, ramp.length_m * sine(ramp.angle_rad), 1e-4);
}

TEST(RoverTest, CarriesItsDotsOnItsDeckAndStandsOnItsWheels) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const TargetLayout layout = random_layout(8, seed);
    for (const Model& model : {make_rover(layout), make_hanging_target(layout)}) {
      ASSERT_EQ(model.marks.size(), layout.size());
      for (std::size_t i = 0; i < layout.size(); ++i) {
        EXPECT_EQ(model.marks[i].centre_m, layout[i].centre_m);
        EXPECT_EQ(model.marks[i].radius_m, 0.5 * layout[i].diameter_m);
      }
      expect_painted_on(model);
    }
  }
  const Model rover = make_rover(demo_layout());
  EXPECT_LT(triangle_count(rover), 20000U);
  double lowest = 1.0;
  double highest = 0.0;
  for_each_corner(rover, [&](const Vector3d& p) {
    lowest = std::min(lowest, p.z());
    highest = std::max(highest, p.z());
    EXPECT_LT(p.head<2>().norm(), 1.05);
  });
  EXPECT_NEAR(lowest, 0.0, 2e-3);
  EXPECT_NEAR(highest, 1.1, 0.05);
}

TEST(PersonTest, IsAsTallAsAPersonAndDressedByTheSeed) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    double lowest = 1.0;
    double highest = 0.0;
    for_each_corner(make_person(seed), [&](const Vector3d& p) {
      lowest = std::min(lowest, p.z());
      highest = std::max(highest, p.z());
      EXPECT_LT(p.head<2>().norm(), 0.6);
    });
    EXPECT_NEAR(lowest, 0.0, 0.01);
    EXPECT_NEAR(highest, 1.76, 0.03);
  }
  EXPECT_NE(make_person(1).parts[0].material.albedo, make_person(3).parts[0].material.albedo);
}

TEST(LookAlikeTest, StandsOnTheGroundWithinReach) {
  std::size_t discs = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Model thing = make_look_alike(seed);
    expect_painted_on(thing);
    discs += thing.marks.size();
    for_each_corner(thing, [&](const Vector3d& p) {
      EXPECT_LT(p.head<2>().norm(), 0.4);
      EXPECT_LT(p.z(), 0.5);
    });
  }
  EXPECT_GT(discs, 60U);
}

}  // namespace
}  // namespace dottrack::host_sim
