// The small steps: one pose from four points, one projection with its derivatives.

#include <benchmark/benchmark.h>

#include <vector>

#include "app/core/geometry/camera_model.h"
#include "app/core/geometry/orientation.h"
#include "tests/bench/room_scene.h"

namespace dottrack::bench {
namespace {

using Eigen::Vector3d;

void pose(benchmark::State& state) {
  std::mt19937 random(17);
  std::normal_distribution<double> noise(0.0, 0.003);
  const core::Target target = room_rig(4).target;
  const Eigen::Quaterniond turn(0.9, 0.1, -0.2, 0.4);
  std::vector<Vector3d> body;
  std::vector<Vector3d> world;
  for (const core::TargetDot& dot : target.dots) {
    body.push_back(dot.position_m);
    world.push_back(turn.normalized() * dot.position_m + Vector3d(3.0, 2.0, 0.4) +
                    Vector3d(noise(random), noise(random), noise(random)));
  }
  geometry::RigidMotion motion;
  auto status = geometry::OrientationStatus::degenerate;
  for (auto _ : state) {
    benchmark::DoNotOptimize(world.data());
    status = geometry::absolute_orientation(body, world, motion);
    benchmark::DoNotOptimize(motion);
  }
  if (status != geometry::OrientationStatus::ok) state.SkipWithError("no pose");
}

void project(benchmark::State& state) {
  const core::Camera camera = room_rig(4).cameras.front();
  std::mt19937 random(19);
  std::vector<Vector3d> points(1024);
  for (Vector3d& point : points) point = point_in_room(random);
  std::size_t i = 0;
  std::size_t failed = 0;
  for (auto _ : state) {
    Eigen::Vector2d pixel;
    geometry::ProjectionJacobian jacobian;
    const auto status = geometry::project(camera.model, points[i++ % 1024], pixel, &jacobian);
    failed += status != geometry::OpticsStatus::ok;
    benchmark::DoNotOptimize(pixel);
    benchmark::DoNotOptimize(jacobian);
  }
  if (failed > i / 2) state.SkipWithError("the points are not in view");
}

BENCHMARK(pose);
BENCHMARK(project);

}  // namespace
}  // namespace dottrack::bench
