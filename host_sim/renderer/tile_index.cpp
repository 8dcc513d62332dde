#include "host_sim/renderer/tile_index.h"

#include <algorithm>
#include <cmath>

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

constexpr double kPupil_m = 0.05;  // how far from the cone's tip lines of sight may start

void set_cone(Tile& tile, const RayLattice& rays) {
  Vector3d sum = Vector3d::Zero();
  std::vector<Vector3d> sights;
  for (int y = tile.box.y0; y <= tile.box.y1; ++y) {
    for (int x = tile.box.x0; x <= tile.box.x1; ++x) {
      const Sight sight = rays.corner(x, y);
      if (sight.direction.isZero(0.0)) continue;
      sights.push_back(sight.direction.normalized());
      sum += sights.back();
      tile.eye = sight.origin;
    }
  }
  if (sights.empty()) return;
  tile.axis = sum.normalized();
  double least = 1.0;
  for (const Vector3d& sight : sights) least = std::min(least, sight.dot(tile.axis));
  tile.cosine = std::max(least - 1e-9, -1.0);
  tile.sine = std::sqrt(1.0 - tile.cosine * tile.cosine);
}

void set_still(Tile& tile, const RayLattice& rays, const Backdrop& backdrop) {
  std::vector<Vector3d> points;
  tile.brightest.assign(backdrop.direct.size(), 0.0F);
  for (int y = tile.box.y0; y < tile.box.y1; ++y) {
    for (int x = tile.box.x0; x < tile.box.x1; ++x) {
      const StillPoint& still = backdrop.points.at(x, y);
      if (still.thing == kNothing) continue;
      const Sight sight = rays.inside(x, y, 0.5, 0.5);
      points.push_back(sight.origin + static_cast<double>(still.distance) * sight.direction);
      for (std::size_t i = 0; i < tile.brightest.size(); ++i) {
        tile.brightest[i] = std::max(tile.brightest[i], backdrop.direct[i].at(x, y));
      }
    }
  }
  if (points.empty()) return;
  Vector3d low = points.front();
  Vector3d high = low;
  for (const Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  tile.still.middle = 0.5 * (low + high);
  for (const Vector3d& p : points) {
    tile.still.radius_m = std::max(tile.still.radius_m, (p - tile.still.middle).norm());
  }
}

// Whether a line from `from` to `to` comes within a margin of the body's box. Only of a body that
// has one pose.
bool line_near_box(const Actor& body, const Vector3d& from, const Vector3d& to, double margin_m) {
  const Vector3d a = body.pose(0).to_body(from);
  const Vector3d step = body.pose(0).to_body(to) - a;
  double enters = 0.0;
  double leaves = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = body.scene->low()[axis] - margin_m - a[axis];
    const double high = body.scene->high()[axis] + margin_m - a[axis];
    if (std::abs(step[axis]) < 1e-12) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    enters = std::max(enters, std::min(low / step[axis], high / step[axis]));
    leaves = std::min(leaves, std::max(low / step[axis], high / step[axis]));
  }
  return enters <= leaves;
}

}  // namespace

TileIndex::TileIndex(const RayLattice& rays, const Backdrop& backdrop)
    : columns_((backdrop.points.width_px() + kTile_px - 1) / kTile_px) {
  const int width_px = backdrop.points.width_px();
  const int height_px = backdrop.points.height_px();
  for (int y = 0; y < height_px; y += kTile_px) {
    for (int x = 0; x < width_px; x += kTile_px) {
      Tile& tile = tiles_.emplace_back();
      tile.box = {x, y, std::min(x + kTile_px, width_px), std::min(y + kTile_px, height_px)};
      set_cone(tile, rays);
      set_still(tile, rays, backdrop);
    }
  }
}

bool may_be_seen(const Actor& body, const Tile& tile) {
  if (tile.axis.isZero(0.0)) return false;
  const double radius_m = body.reach.radius_m + kPupil_m;
  const Vector3d to_body = body.reach.middle - tile.eye;
  const double along = to_body.dot(tile.axis);
  const double across = std::sqrt(std::max(to_body.squaredNorm() - along * along, 0.0));
  if (across * tile.cosine - along * tile.sine > radius_m) return false;
  if (body.poses.size() > 1 || tile.cosine < 0.5) return true;
  const double farthest_m = std::max(along + radius_m, 0.0);
  return line_near_box(body, tile.eye, tile.eye + farthest_m * tile.axis,
                       farthest_m * tile.sine / tile.cosine + kPupil_m);
}

bool may_shade(const Actor& body, const Tile& tile, const LampLight& lamp) {
  if (!may_hide(body.reach, tile.still, lamp.reach)) return false;
  if (body.poses.size() > 1) return true;
  return line_near_box(body, tile.still.middle, lamp.reach.middle,
                       std::max(tile.still.radius_m, lamp.reach.radius_m));
}

}  // namespace dottrack::host_sim
