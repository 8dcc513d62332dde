// Stones: a ball of triangles, cut by planes and roughened.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "host_sim/world/meshes.h"
#include "host_sim/world/noise.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

struct BallMesh {
  std::vector<Vector3d> vertices;  // unit
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

BallMesh octahedron() {
  return {{Vector3d::UnitX(), -Vector3d::UnitX(), Vector3d::UnitY(), -Vector3d::UnitY(),
           Vector3d::UnitZ(), -Vector3d::UnitZ()},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

BallMesh subdivided(const BallMesh& ball) {
  BallMesh finer;
  finer.vertices = ball.vertices;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(finer.vertices.size()));
    if (is_new) finer.vertices.push_back((ball.vertices[a] + ball.vertices[b]).normalized());
    return at->second;
  };
  for (const auto& [a, b, c] : ball.triangles) {
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t bc = middle(b, c);
    const std::uint32_t ca = middle(c, a);
    finer.triangles.insert(finer.triangles.end(),
                           {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return finer;
}

Vector3d random_direction(RandomStream& random) {
  for (;;) {
    const Vector3d v{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                     random.uniform(-1.0, 1.0)};
    if (v.squaredNorm() > 0.01 && v.squaredNorm() < 1.0) return v.normalized();
  }
}

struct Cut {
  Vector3d normal;
  double reach;
};

double reach_along(const Vector3d& direction, const std::vector<Cut>& cuts) {
  double reach = 1.0;
  for (const Cut& cut : cuts) {
    const double along = cut.normal.dot(direction);
    if (along > 0.0) reach = std::min(reach, cut.reach / along);
  }
  return reach;
}

}  // namespace

TriangleMesh rock(std::uint64_t seed, double radius_m) {
  RandomStream random(seed, 0x40C);
  std::vector<Cut> cuts;
  for (int i = 0; i < 14; ++i) {
    Cut cut;
    cut.normal = random_direction(random);
    cut.reach = random.uniform(0.62, 0.95);
    cuts.push_back(cut);
  }
  const Vector3d squeeze{random.uniform(0.75, 1.0), random.uniform(0.65, 1.0),
                         random.uniform(0.5, 0.85)};
  BallMesh ball = octahedron();
  const int levels = radius_m < 0.09 ? 2 : 3;
  for (int i = 0; i < levels; ++i) ball = subdivided(ball);
  TriangleMesh mesh;
  mesh.triangles = ball.triangles;
  for (const Vector3d& direction : ball.vertices) {
    const double rough = 0.5 * (value_noise(Vector3d(direction * 2.3), seed) +
                                0.5 * value_noise(Vector3d(direction * 5.9), seed + 1));
    const double reach = reach_along(direction, cuts) * (0.90 + 0.12 * rough);
    mesh.vertices.push_back((radius_m * reach * direction.cwiseProduct(squeeze)).cast<float>());
  }
  return mesh;
}

}  // namespace dottrack::host_sim
