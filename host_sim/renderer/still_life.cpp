#include "host_sim/renderer/still_life.h"

#include <algorithm>
#include <cmath>

#include "host_sim/renderer/image_buffer.h"

namespace dottrack::host_sim {
namespace {

constexpr int kTile_px = 16;
constexpr double kSlack_rad = 1e-6;

int tiles_across(int length_px) {
  return (length_px + kTile_px - 1) / kTile_px;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// A cone of lines of sight.
struct Cone {
  Eigen::Vector3d axis;
  double half_angle_rad;
};

Cone cone_of(const PixelBox& box, const RayLattice& rays) {
  Cone cone{rays.corner((box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2), 0.0};
  for (const int x : {box.x0, (box.x0 + box.x1) / 2, box.x1}) {
    for (const int y : {box.y0, (box.y0 + box.y1) / 2, box.y1}) {
      cone.half_angle_rad =
          std::max(cone.half_angle_rad, angle_between(cone.axis, rays.corner(x, y)));
    }
  }
  return cone;
}

bool may_meet(const Cone& cone, const Eigen::Vector3d& eye, const Ball& ball) {
  const Eigen::Vector3d to_centre = ball.centre - eye;
  const double distance = to_centre.norm();
  if (distance <= ball.radius_m) return true;
  const double ball_angle = std::asin(ball.radius_m / distance);
  return angle_between(cone.axis, to_centre) <=
         cone.half_angle_rad * 1.02 + ball_angle + kSlack_rad;
}

}  // namespace

StillLife::StillLife(std::span<const Object> objects, const SimCamera& camera,
                     const RayLattice& rays)
    : eye_(camera.centre_m()),
      objects_(objects, camera.centre_m()),
      tile_columns_(tiles_across(camera.width_px())) {
  for (int row = 0; row < tiles_across(camera.height_px()); ++row) {
    for (int column = 0; column < tile_columns_; ++column) {
      tiles_.push_back(fill_tile(column, row, camera, rays));
    }
  }
}

StillLife::Tile StillLife::fill_tile(int column, int row, const SimCamera& camera,
                                     const RayLattice& rays) const {
  const PixelBox box{column * kTile_px, row * kTile_px,
                     std::min((column + 1) * kTile_px, camera.width_px()),
                     std::min((row + 1) * kTile_px, camera.height_px())};
  const Cone cone = cone_of(box, rays);
  Tile tile;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (may_meet(cone, eye_, objects_[i].bound)) tile.push_back(static_cast<std::uint16_t>(i));
  }
  return tile;
}

const StillLife::Tile& StillLife::tile_of(int x, int y) const {
  return tiles_[static_cast<std::size_t>(y / kTile_px * tile_columns_ + x / kTile_px)];
}

SurfaceHit StillLife::cast(int x, int y, const Eigen::Vector3d& direction) const {
  SurfaceHit result;
  const Line line{eye_, direction};
  Hit hit{result.distance, Eigen::Vector3d::UnitZ()};
  if (direction.z() < 0.0) {
    hit.distance = -eye_.z() / direction.z();
    result.surface = kGround;
  }
  for (const std::uint16_t i : tile_of(x, y)) {
    if (objects_.nearer(i, line, hit)) result.surface = kFirstObject + i;
  }
  result.distance = hit.distance;
  result.normal = hit.normal;
  return result;
}

bool StillLife::hides(int x, int y, const Eigen::Vector3d& direction, double distance) const {
  const Line line{eye_, direction};
  Hit hit{distance, Eigen::Vector3d::Zero()};
  const Tile& tile = tile_of(x, y);
  return std::any_of(tile.begin(), tile.end(),
                     [&](std::uint16_t i) { return objects_.nearer(i, line, hit); });
}

}  // namespace dottrack::host_sim
