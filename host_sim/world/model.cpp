#include "host_sim/world/model.h"

#include <utility>

#include "host_sim/world/meshes.h"

namespace dottrack::host_sim {
namespace {

Eigen::Vector4f moved(const Eigen::Vector4f& ball, const Pose& pose) {
  Eigen::Vector4f result = ball;
  result.head<3>() = pose.to_world(ball.head<3>().cast<double>()).cast<float>();
  return result;
}

Solid moved(const Solid& solid, const Pose& pose) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&solid)) return transformed(*mesh, pose);
  if (const auto* balls = std::get_if<Balls>(&solid)) {
    Balls result;
    for (const auto& ball : balls->balls) result.balls.push_back(moved(ball, pose));
    return result;
  }
  Cable result;
  for (const auto& point : std::get<Cable>(solid).path) result.path.push_back(moved(point, pose));
  return result;
}

}  // namespace

std::size_t add(Model& model, Solid solid, const Material& material) {
  model.parts.push_back({std::move(solid), material});
  return model.parts.size() - 1;
}

std::size_t append(Model& model, const Model& other, const Pose& pose) {
  const std::size_t first = model.parts.size();
  for (const Part& part : other.parts) add(model, moved(part.solid, pose), part.material);
  for (Mark mark : other.marks) {
    mark.centre_m = pose.to_world(mark.centre_m);
    mark.normal = pose.rotation * mark.normal;
    mark.part += first;
    model.marks.push_back(mark);
  }
  return first;
}

std::size_t triangle_count(const Model& model) {
  std::size_t count = 0;
  for (const Part& part : model.parts) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&part.solid)) count += mesh->triangles.size();
  }
  return count;
}

}  // namespace dottrack::host_sim
