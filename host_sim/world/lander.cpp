// The mock lander.

#include "host_sim/world/hall_parts.h"
#include "host_sim/world/meshes.h"
#include "host_sim/world/outline.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A strap around an ellipsoid with these semi-axes, over its top, across its x axis.
Cable strap(const Pose& middle, const Vector3d& semi_axes_m) {
  constexpr int kPieces = 28;
  Cable cable;
  for (int i = 0; i <= kPieces; ++i) {
    const double angle = 2.0 * kPi * i / kPieces;
    const Vector3d p = middle.to_world(
        {0.0, 1.005 * semi_axes_m.y() * cosine(angle), 1.005 * semi_axes_m.z() * sine(angle)});
    cable.path.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()),
                            static_cast<float>(p.z()), 0.007F);
  }
  return cable;
}

// Six lobes around a middle, overlapping, like a raspberry.
void add_bags(Model& lander, const Vector3d& middle, double yaw_rad, RandomStream& random) {
  const Pose cluster = upright(middle, yaw_rad);
  for (int lobe = 0; lobe < 6; ++lobe) {
    const double angle = radians(60.0 * lobe);
    const double rise = lobe % 2 == 0 ? 0.10 : -0.04;
    const Vector3d at(0.20 * cosine(angle), 0.25 * sine(angle), rise);
    const double size = random.uniform(0.25, 0.31);
    const Vector3d axes{size * random.uniform(0.9, 1.1), size * random.uniform(0.9, 1.1),
                        size * random.uniform(0.85, 1.0)};
    const Material bag{random.uniform(0.58, 0.82), Pattern::plain, 0.5};
    const Pose lobe_pose = upright(cluster.to_world(at), yaw_rad + angle);
    add(lander, ellipsoid(lobe_pose, axes, 16), bag);
    add(lander, strap(lobe_pose, axes), {0.42, Pattern::plain, 0.1});
    // A tie on top, as the bags had.
    const Vector3d tie = cluster.to_world(at + Vector3d(0.0, 0.0, axes.z() - 0.004));
    add(lander, ellipsoid(upright(tie), {0.03, 0.03, 0.012}, 6), {0.45, Pattern::plain, 0.2});
  }
}

void add_petal(Model& lander, double yaw_rad) {
  const Outline petal = {{0.28, -0.30}, {0.62, -0.18}, {0.78, 0.0}, {0.62, 0.18}, {0.28, 0.30}};
  const Pose pose = upright({0.0, 0.0, 0.0}, yaw_rad);
  add(lander, transformed(prism(petal, 0.26, 0.30), pose), {0.22, Pattern::cells, 0.3, 12});
  add(lander, limb(pose.to_world({0.3, 0.0, 0.24}), pose.to_world({0.7, 0.0, 0.12}), 0.03, 0.03),
      {0.35, Pattern::plain, 0.3});
}

}  // namespace

Model make_lander(std::uint64_t seed) {
  RandomStream random(seed, 0xBA65);
  Model lander;
  add(lander, cylinder({0.0, 0.0, 0.05}, Vector3d::UnitZ(), 0.24, 0.44, 6),
      {0.28, Pattern::mottled, 0.3, 13});
  add(lander, disc_plate({0.0, 0.0, 0.33}, Vector3d::UnitZ(), 0.40, 0.05, 32),
      {0.18, Pattern::plain, 0.2});
  add(lander, disc_plate({0.05, 0.02, 0.345}, Vector3d::UnitZ(), 0.055, 0.02), {0.8});
  for (int petal = 0; petal < 4; ++petal) {
    const double yaw_rad = radians(90.0 * petal);
    add_petal(lander, yaw_rad);
    const Vector3d at(0.74 * cosine(yaw_rad), 0.74 * sine(yaw_rad), 0.26);
    add_bags(lander, at, yaw_rad, random);
  }
  return lander;
}

}  // namespace dottrack::host_sim
