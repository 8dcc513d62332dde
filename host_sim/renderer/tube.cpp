#include "host_sim/renderer/tube.h"

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

// Along the cable at one of its points; a repeated point has the direction of those before it.
std::vector<Vector3d> directions(const Cable& cable) {
  const std::size_t count = cable.path.size();
  std::vector<Vector3d> along(count);
  Vector3d last = Vector3d::UnitX();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector4f& before = cable.path[i == 0 ? 0 : i - 1];
    const Eigen::Vector4f& after = cable.path[i + 1 == count ? i : i + 1];
    const Vector3d step = (after - before).head<3>().cast<double>();
    if (step.squaredNorm() > 0.0) last = step.normalized();
    along[i] = last;
  }
  return along;
}

void add_ring(TriangleMesh& tube, const Eigen::Vector4d& point, const Vector3d& u,
              const Vector3d& v) {
  const double radius_m = point.w() / cosine(kPi / kTubeSides);  // the faces touch the cable
  for (std::uint32_t side = 0; side < kTubeSides; ++side) {
    const double angle = 2.0 * kPi * side / kTubeSides;
    const Vector3d p = point.head<3>() + radius_m * (cosine(angle) * u + sine(angle) * v);
    tube.vertices.push_back(p.cast<float>());
  }
}

}  // namespace

TriangleMesh tube_around(const Cable& cable) {
  TriangleMesh tube;
  const std::vector<Vector3d> along = directions(cable);
  Vector3d u = along.front().unitOrthogonal();
  for (std::size_t i = 0; i < along.size(); ++i) {
    const Vector3d carried = u - u.dot(along[i]) * along[i];  // from ring to ring without a twist
    u = carried.squaredNorm() > 1e-6 ? carried.normalized() : along[i].unitOrthogonal();
    add_ring(tube, cable.path[i].cast<double>(), u, along[i].cross(u));
  }
  const auto segments = static_cast<std::uint32_t>(along.size() - 1);
  for (std::uint32_t segment = 0; segment < segments; ++segment) {
    const std::uint32_t ring = segment * kTubeSides;
    for (std::uint32_t side = 0; side < kTubeSides; ++side) {
      const std::uint32_t a = ring + side;
      const std::uint32_t b = ring + (side + 1) % kTubeSides;
      tube.triangles.push_back({a, b, b + kTubeSides});
      tube.triangles.push_back({a, b + kTubeSides, a + kTubeSides});
    }
  }
  return tube;
}

}  // namespace dottrack::host_sim
