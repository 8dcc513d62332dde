#pragma once
// A test bench for the renderer: plain things under plain light, and where they must appear.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "host_sim/renderer/camera_view.h"
#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim::bench {

using Eigen::Vector2d;
using Eigen::Vector3d;

inline constexpr double kDark = 0.05;
inline constexpr double kWhite = 0.80;

// A sensor that adds nothing but rounding.
inline SensorModel plain_sensor(double blur_sigma_px = 0.0) {
  SensorModel sensor;
  sensor.blur_sigma_px = blur_sigma_px;
  sensor.sensitivity = 1.0;
  sensor.corner_falloff = 0.0;
  sensor.noise = false;
  return sensor;
}

inline void add_face(TriangleMesh& mesh, const Vector3d& middle, const Vector3d& u,
                     const Vector3d& v) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vector3d& p : {Vector3d(middle - u - v), Vector3d(middle + u - v),
                            Vector3d(middle + u + v), Vector3d(middle - u + v)}) {
    mesh.vertices.push_back(p.cast<float>());
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

inline Part box(const Vector3d& middle, const Vector3d& half, double albedo) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vector3d normal = side * Vector3d::Unit(axis);
      const Vector3d u = Vector3d::Unit((axis + 1) % 3);
      const Vector3d v = normal.cross(u);
      add_face(mesh, middle + half[axis] * normal, half.cwiseProduct(u), half.cwiseProduct(v));
    }
  }
  return {mesh, {.albedo = albedo}};
}

// A level plate without thickness, seen from both sides.
inline Part plate(const Vector3d& middle, double half_x_m, double half_y_m, double albedo) {
  TriangleMesh mesh;
  add_face(mesh, middle, {half_x_m, 0.0, 0.0}, {0.0, half_y_m, 0.0});
  return {mesh, {.albedo = albedo}};
}

inline Mark dot(const Vector3d& centre_m, double radius_m, std::size_t part = 0) {
  return {centre_m, Vector3d::UnitZ(), radius_m, kWhite, part};
}

// A dark floor, z = 0.
inline Model dark_floor() {
  return {{plate(Vector3d::Zero(), 20.0, 20.0, kDark)}, {}};
}

// Light from everywhere: radiance of a white surface that faces upwards.
inline Lamp glow(double radiance) {
  return {"glow", {0.0, 0.0, 9.0}, {0.1, 0.0, 0.0}, {0.0, -0.1, 0.0}, 0.0, radiance};
}

// A square lamp that shines downwards, radiance at a white floor below it.
inline Lamp lamp_above(const std::string& group, const Vector3d& at_m, double half_m,
                       double radiance) {
  return {group, at_m, {half_m, 0.0, 0.0}, {0.0, -half_m, 0.0}, radiance * at_m.z() * at_m.z(),
          0.0};
}

inline SimCamera camera_over(const Vector3d& eye, const Vector3d& aim, int width_px = 320,
                             int height_px = 240) {
  Lens lens;
  lens.centre_x_px = 0.5 * (width_px - 1);
  lens.centre_y_px = 0.5 * (height_px - 1);
  return {eye, looking_at(eye, aim, 0.1, Vector3d::UnitY()), lens, width_px, height_px};
}

inline const SimCamera& overhead() {
  static const SimCamera camera = camera_over({0.3, 0.2, 5.0}, {0.0, 0.0, 0.0});
  return camera;
}

// A body before the camera: the model, and its motion.
struct Moving {
  Moving(Model model, Motion how) : scene(std::move(model)), motion(std::move(how)) {}
  MovingBody body() const { return {&scene, &motion}; }

  RayScene scene;
  Motion motion;
};

inline Motion standing(const Pose& pose) {
  return [pose](double) { return pose; };
}

inline GreyImage picture(CameraView& view, std::vector<MovingBody> bodies = {},
                         const LightPlan& plan = {}, const Exposure& exposure = {}) {
  GreyImage image;
  view.render(exposure, bodies, plan, image);
  return image;
}

struct Centre {
  Vector2d pixel = Vector2d::Zero();
  double area_px = 0.0;  // the light above the floor's, in that of a dot's pixel
};

// Centroid of what is brighter than the floor, in a window around a place.
inline Centre measure(const GreyImage& image, const Vector2d& around, int reach = 20) {
  const int x0 = static_cast<int>(std::lround(around.x()));
  const int y0 = static_cast<int>(std::lround(around.y()));
  const double floor_dn = image.at(x0 - reach, y0 - reach);
  const double dot_dn = image.at(x0, y0);
  Centre centre;
  for (int y = y0 - reach; y <= y0 + reach; ++y) {
    for (int x = x0 - reach; x <= x0 + reach; ++x) {
      const double excess = image.at(x, y) - floor_dn;
      centre.pixel += excess * Vector2d(x, y);
      centre.area_px += excess;
    }
  }
  centre.pixel /= centre.area_px;
  centre.area_px /= dot_dn - floor_dn;
  return centre;
}

// Centroid and area of a disc's picture, from its outline projected point by point.
inline Centre expected(const SimCamera& camera, const Vector3d& middle, const Vector3d& normal,
                       double radius_m) {
  const Vector3d u = normal.unitOrthogonal();
  const Vector3d v = normal.cross(u);
  constexpr int kPoints = 720;
  const Vector2d origin = *camera.project(middle);
  Centre sum;
  Vector2d last = Vector2d::Zero();
  for (int i = 0; i <= kPoints; ++i) {
    const double angle = 2.0 * kPi * i / kPoints;
    const Vector3d p = middle + radius_m * (std::cos(angle) * u + std::sin(angle) * v);
    const Vector2d here = *camera.project(p) - origin;
    if (i > 0) {
      const double cross = last.x() * here.y() - last.y() * here.x();
      sum.area_px += 0.5 * cross;
      sum.pixel += cross / 6.0 * (last + here);
    }
    last = here;
  }
  return {origin + sum.pixel / sum.area_px, std::abs(sum.area_px)};
}

}  // namespace dottrack::host_sim::bench
