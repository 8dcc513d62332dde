#include "app/core/geometry/camera_model.h"

#include <cassert>

namespace dottrack::geometry {
namespace {

// std::visit would throw on a variant without a value, which three plain structs cannot become.
template <class Function>
decltype(auto) visit(const CameraModel& model, Function&& function) noexcept {
  if (const Cahvor* cahvor = std::get_if<Cahvor>(&model)) return function(*cahvor);
  if (const Cahvore* cahvore = std::get_if<Cahvore>(&model)) return function(*cahvore);
  return function(*std::get_if<Cahv>(&model));
}

}  // namespace

OpticsStatus project(const CameraModel& model, const Eigen::Vector3d& p_world,
                     Eigen::Vector2d& pixel, ProjectionJacobian* jacobian) noexcept {
  return visit(model, [&](const auto& m) { return project(m, p_world, pixel, jacobian); });
}

OpticsStatus unproject(const CameraModel& model, const Eigen::Vector2d& pixel, Ray& ray,
                       RayJacobian* jacobian) noexcept {
  return visit(model, [&](const auto& m) { return unproject(m, pixel, ray, jacobian); });
}

void project_all(const CameraModel& model, std::span<const Eigen::Vector3d> p_world,
                 std::span<Eigen::Vector2d> pixels, std::span<OpticsStatus> statuses) noexcept {
  assert(pixels.size() == p_world.size() && statuses.size() == p_world.size());
  visit(model, [&](const auto& m) {
    for (std::size_t i = 0; i < p_world.size(); ++i) {
      statuses[i] = project(m, p_world[i], pixels[i]);
    }
  });
}

void project_all(const CameraModel& model, std::span<const Eigen::Vector3d> p_world,
                 std::span<Eigen::Vector2d> pixels, std::span<ProjectionJacobian> jacobians,
                 std::span<OpticsStatus> statuses) noexcept {
  assert(pixels.size() == p_world.size() && statuses.size() == p_world.size());
  assert(jacobians.size() == p_world.size());
  visit(model, [&](const auto& m) {
    for (std::size_t i = 0; i < p_world.size(); ++i) {
      statuses[i] = project(m, p_world[i], pixels[i], &jacobians[i]);
    }
  });
}

void unproject_all(const CameraModel& model, std::span<const Eigen::Vector2d> pixels,
                   std::span<Ray> rays, std::span<OpticsStatus> statuses) noexcept {
  assert(rays.size() == pixels.size() && statuses.size() == pixels.size());
  visit(model, [&](const auto& m) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      statuses[i] = unproject(m, pixels[i], rays[i]);
    }
  });
}

void unproject_all(const CameraModel& model, std::span<const Eigen::Vector2d> pixels,
                   std::span<Ray> rays, std::span<RayJacobian> jacobians,
                   std::span<OpticsStatus> statuses) noexcept {
  assert(rays.size() == pixels.size() && statuses.size() == pixels.size());
  assert(jacobians.size() == pixels.size());
  visit(model, [&](const auto& m) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      statuses[i] = unproject(m, pixels[i], rays[i], &jacobians[i]);
    }
  });
}

std::string_view class_name(const CameraModel& model) noexcept {
  if (std::holds_alternative<Cahvor>(model)) return "CAHVOR";
  return std::holds_alternative<Cahvore>(model) ? "CAHVORE" : "CAHV";
}

const Eigen::Vector3d& centre(const CameraModel& model) noexcept {
  return visit(model, [](const auto& m) -> const Eigen::Vector3d& { return m.c; });
}

bool as_cahvor(const CameraModel& model, Cahvor& cahvor) noexcept {
  if (const auto* same = std::get_if<Cahvor>(&model)) {
    cahvor = *same;
    return true;
  }
  const auto* plain = std::get_if<Cahv>(&model);
  if (plain == nullptr) return false;
  cahvor = {plain->c, plain->a, plain->h, plain->v, plain->a, Eigen::Vector3d::Zero()};
  return true;
}

}  // namespace dottrack::geometry
