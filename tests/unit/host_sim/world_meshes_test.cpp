// Solids: closed, the right way out, of the size that was asked for.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "host_sim/world/meshes.h"
#include "host_sim/world/outline.h"
#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d corner(const TriangleMesh& mesh, std::uint32_t i) {
  return mesh.vertices[i].cast<double>();
}

double volume_m3(const TriangleMesh& mesh) {
  double six = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    six += corner(mesh, a).dot(corner(mesh, b).cross(corner(mesh, c)));
  }
  return six / 6.0;
}

// Every edge is walked once in each direction; edges are known by their ends' places.
bool is_closed(const TriangleMesh& mesh) {
  using Point = std::array<float, 3>;
  std::map<std::pair<Point, Point>, int> walked;
  const auto point = [&](std::uint32_t i) {
    const Eigen::Vector3f& v = mesh.vertices[i];
    return Point{v.x() + 0.0F, v.y() + 0.0F, v.z() + 0.0F};
  };
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point from = point(triangle[i]);
      const Point to = point(triangle[(i + 1) % 3]);
      if (from == to) return false;
      ++walked[{from, to}];
      --walked[{to, from}];
    }
  }
  for (const auto& [edge, times] : walked) {
    if (times != 0) return false;
  }
  return true;
}

Pose askew() {
  Pose pose = facing({0.4, -0.2, 0.3}, Vector3d(0.3, -0.5, 0.8).normalized());
  return pose;
}

TEST(MeshesTest, AreClosedAndOfTheRightVolume) {
  const Vector3d axis = Vector3d(0.3, -0.5, 0.8).normalized();
  const double many = 64;
  const auto shrunk = [](double sides) { return sides / (2.0 * kPi) * sine(2.0 * kPi / sides); };
  const Outline bay = {{0, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}};
  const std::vector<std::pair<TriangleMesh, double>> solids = {
      {box(askew(), {0.2, 0.3, 0.5}), 0.03},
      {cylinder({1, 2, 3}, axis, 0.5, 0.2, 64), kPi * 0.02 * shrunk(many)},
      {stump({1, 2, 3}, axis, 0.6, 0.2, 0.1, 64), kPi * 0.2 * 0.07 * shrunk(many)},
      {disc_plate({1, 2, 3}, axis, 0.2, 0.1, 64), kPi * 0.004 * shrunk(many)},
      {prism(bay, -0.5, 0.5), 2.5},
      {ellipsoid(askew(), {0.1, 0.2, 0.3}, 48), 4.0 / 3.0 * kPi * 0.006},
      {limb({0, 0, 0}, {0, 0.3, 0.4}, 0.1, 0.1, 64), kPi * 0.01 * (0.5 + 4.0 / 3.0 * 0.1)},
  };
  for (std::size_t i = 0; i < solids.size(); ++i) {
    EXPECT_TRUE(is_closed(solids[i].first)) << i;
    EXPECT_NEAR(volume_m3(solids[i].first) / solids[i].second, 1.0, i < 5 ? 1e-5 : 0.02) << i;
  }
}

TEST(MeshesTest, ADiscPlatesFaceIsWhereItIsAskedFor) {
  const Vector3d normal = Vector3d(0.3, -0.5, 0.8).normalized();
  const Vector3d face(1.0, 2.0, 3.0);
  const TriangleMesh mesh = disc_plate(face, normal, 0.2, 0.1);
  double highest = -1.0;
  for (const auto& v : mesh.vertices) {
    highest = std::max(highest, normal.dot(v.cast<double>() - face));
  }
  EXPECT_NEAR(highest, 0.0, 1e-6);
}

TEST(MeshesTest, RocksAreClosedIrregularAndWithinTheirRadius) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const double radius_m = 0.05 + 0.02 * static_cast<double>(seed);
    const TriangleMesh mesh = rock(seed, radius_m);
    EXPECT_TRUE(is_closed(mesh)) << seed;
    double farthest = 0.0;
    double nearest = 1.0;
    for (const auto& v : mesh.vertices) {
      farthest = std::max(farthest, static_cast<double>(v.norm()));
      nearest = std::min(nearest, static_cast<double>(v.norm()));
    }
    EXPECT_LE(farthest, radius_m) << seed;
    EXPECT_GT(farthest, 0.6 * radius_m) << seed;
    EXPECT_LT(nearest, 0.8 * farthest) << seed;
    EXPECT_GT(volume_m3(mesh), 0.4 * radius_m * radius_m * radius_m) << seed;
  }
}

TEST(MeshesTest, AHeightfieldFollowsItsFunctionAndFacesUp) {
  const auto height = [](const Vector2d& p) { return 0.3 * p.x() - 0.2 * p.y() + 0.1; };
  const TriangleMesh mesh = heightfield(height, {-1.0, 1.0}, {0.0, 0.5}, 0.1);
  EXPECT_EQ(mesh.triangles.size(), 200U);
  for (const auto& v : mesh.vertices) {
    EXPECT_NEAR(v.z(), height(v.head<2>().cast<double>()), 1e-6);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d ab = corner(mesh, b) - corner(mesh, a);
    EXPECT_GT(ab.cross(corner(mesh, c) - corner(mesh, a)).z(), 0.0);
  }
}

TEST(MeshesTest, AnAppendedModelKeepsItsMarksOnItsParts) {
  Model plate;
  add(plate, Balls{{{0.0F, 0.0F, 0.5F, 0.1F}}}, {});
  const std::size_t part = add(plate, box({0.0, 0.0, -0.05}, {1.0, 1.0, 0.1}), {});
  plate.marks.push_back({Vector3d::Zero(), Vector3d::UnitZ(), 0.05, 0.9, part});
  Model all;
  add(all, box({9.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), {});
  EXPECT_EQ(append(all, plate, askew()), 1U);
  ASSERT_EQ(all.marks.size(), 1U);
  EXPECT_EQ(all.marks[0].part, 2U);
  EXPECT_LT((all.marks[0].centre_m - askew().position_m).norm(), 1e-12);
  EXPECT_LT((all.marks[0].normal - askew().rotation.col(2)).norm(), 1e-12);
  const auto& ball = std::get<Balls>(all.parts[1].solid).balls[0];
  const Vector3d wanted = askew().to_world({0.0, 0.0, 0.5});
  EXPECT_LT((ball.head<3>().cast<double>() - wanted).norm(), 1e-6);
  EXPECT_EQ(triangle_count(all), 24U);
}

TEST(OutlineTest, MayHaveABay) {
  const Outline bay = {{0, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}};
  EXPECT_TRUE(inside(bay, {1.0, 0.3}));
  EXPECT_FALSE(inside(bay, {1.0, 1.0}));
  EXPECT_NEAR(distance_to_edge(bay, {1.0, 0.2}), 0.2, 1e-12);
  double area = 0.0;
  for (const auto& [a, b, c] : triangulated(bay)) {
    const Vector2d u = bay[b] - bay[a];
    const Vector2d v = bay[c] - bay[a];
    EXPECT_GT(u.x() * v.y() - u.y() * v.x(), 0.0);
    area += 0.5 * (u.x() * v.y() - u.y() * v.x());
  }
  EXPECT_NEAR(area, 2.5, 1e-12);
}

}  // namespace
}  // namespace dottrack::host_sim
