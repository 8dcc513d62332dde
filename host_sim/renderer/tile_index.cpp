#include "host_sim/renderer/tile_index.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dottrack::host_sim {
namespace {

constexpr double kSlack_rad = 1e-6;

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// A cone of lines of sight; also that of a ball seen from the eye.
struct Cone {
  Eigen::Vector3d axis;
  double half_angle_rad;
};

Cone cone_of_tile(const PixelBox& tile, const std::function<Eigen::Vector3d(int, int)>& corner) {
  Cone cone{corner((tile.x0 + tile.x1) / 2, (tile.y0 + tile.y1) / 2), 0.0};
  for (const int x : {tile.x0, tile.x1}) {
    for (const int y : {tile.y0, tile.y1}) {
      const double angle_rad = angle_between(cone.axis, corner(x, y));
      cone.half_angle_rad = std::max(cone.half_angle_rad, 1.02 * angle_rad + kSlack_rad);
    }
  }
  return cone;
}

// The half angle is over pi when the eye is inside the ball: it is everywhere.
Cone cone_of_ball(const Ball& ball, const Eigen::Vector3d& eye) {
  const Eigen::Vector3d to_centre = ball.centre - eye;
  const double distance_m = to_centre.norm();
  const bool inside = distance_m <= ball.radius_m;
  return {to_centre, inside ? 4.0 : std::asin(ball.radius_m / distance_m)};
}

bool overlap(const Cone& a, const Cone& b) {
  return angle_between(a.axis, b.axis) <= a.half_angle_rad + b.half_angle_rad;
}

}  // namespace

TileIndex::TileIndex(std::span<const Ball> balls, const Eigen::Vector3d& eye, const PixelBox& box,
                     const std::function<Eigen::Vector3d(int, int)>& corner)
    : box_(box), columns_((box.x1 - box.x0 + kTile_px - 1) / kTile_px) {
  std::vector<Cone> cones;
  for (const Ball& ball : balls) cones.push_back(cone_of_ball(ball, eye));
  for (int y = box.y0; y < box.y1; y += kTile_px) {
    for (int x = box.x0; x < box.x1; x += kTile_px) {
      const PixelBox tile{x, y, std::min(x + kTile_px, box.x1), std::min(y + kTile_px, box.y1)};
      const Cone sight = cone_of_tile(tile, corner);
      std::vector<std::uint16_t>& seen = tiles_.emplace_back();
      for (std::size_t i = 0; i < cones.size(); ++i) {
        if (overlap(sight, cones[i])) seen.push_back(static_cast<std::uint16_t>(i));
      }
    }
  }
}

}  // namespace dottrack::host_sim
