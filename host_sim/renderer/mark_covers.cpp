#include "host_sim/renderer/mark_covers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

constexpr int kLines = 16;
constexpr int kCorners = 16;           // of the polygon around a mark that finds its pixels
constexpr double kPolygonScale = 1.1;  // it holds the disc, and the lens may bend its sides

// A disc in the world.
struct Disc {
  Vector3d centre;
  Vector3d normal;
  double radius_m;
};

// With the line of sight o + t (a + u b), u along a line across the pixel, the meeting point with
// the disc's plane lies inside the disc where a quadratic in u is negative. Its share of [0, 1].
double share_of_line(const Disc& disc, const Vector3d& origin, const Vector3d& a,
                     const Vector3d& b) {
  const Vector3d w = origin - disc.centre;
  const double height = disc.normal.dot(w);
  const double na = disc.normal.dot(a);
  const double nb = disc.normal.dot(b);
  const Vector3d at_0 = w * na - a * height;
  const Vector3d per_u = w * nb - b * height;
  const double r2 = disc.radius_m * disc.radius_m;
  const double q2 = per_u.squaredNorm() - r2 * nb * nb;
  const double q1 = at_0.dot(per_u) - r2 * na * nb;  // half the linear term
  const double q0 = at_0.squaredNorm() - r2 * na * na;
  const double discriminant = q1 * q1 - q2 * q0;
  if (!(q2 > 0.0 && discriminant > 0.0)) return 0.0;
  const double half = std::sqrt(discriminant);
  const double enters = std::clamp((-q1 - half) / q2, 0.0, 1.0);
  const double leaves = std::clamp((-q1 + half) / q2, 0.0, 1.0);
  return leaves - enters;
}

void include(PixelBox& box, const Eigen::Vector2d& pixel) {
  const int x = static_cast<int>(std::floor(std::clamp(pixel.x(), -1e6, 1e6)));
  const int y = static_cast<int>(std::floor(std::clamp(pixel.y(), -1e6, 1e6)));
  const PixelBox here{x, y, x + 2, y + 2};
  box = box.empty() ? here
                    : PixelBox{std::min(box.x0, here.x0), std::min(box.y0, here.y0),
                               std::max(box.x1, here.x1), std::max(box.y1, here.y1)};
}

PixelBox around(const PixelBox& a, const PixelBox& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

}  // namespace

MarkCovers::MarkCovers(std::span<const Actor> actors, const SimCamera& camera,
                       const RayLattice& rays)
    : camera_(camera), rays_(rays) {
  for (const Actor& actor : actors) {
    const std::size_t count = actor.scene->model().marks.size();
    for (std::size_t i = 0; i < count; ++i) add(actor, static_cast<int>(i));
  }
  std::stable_sort(covers_.begin(), covers_.end(),
                   [](const MarkCover& a, const MarkCover& b) { return a.pixel < b.pixel; });
}

std::span<const MarkCover> MarkCovers::at(int x, int y) const {
  const int pixel = y * camera_.width_px() + x;
  const auto first =
      std::lower_bound(covers_.begin(), covers_.end(), pixel,
                       [](const MarkCover& c, int wanted) { return c.pixel < wanted; });
  auto last = first;
  while (last != covers_.end() && last->pixel == pixel) ++last;
  return {first, last};
}

// The pixels that the mark may touch in the pose of a row.
PixelBox MarkCovers::box_of(const Actor& actor, const Mark& mark, int row) const {
  const Pose& pose = actor.pose(row);
  const Vector3d u = mark.normal.unitOrthogonal() * (kPolygonScale * mark.radius_m);
  const Vector3d v = mark.normal.cross(u);
  PixelBox box;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * kPi * i / kCorners;
    const Vector3d corner = mark.centre_m + cosine(angle) * u + sine(angle) * v;
    if (const auto pixel = camera_.project(pose.to_world(corner))) include(box, *pixel);
  }
  return box.empty() ? PixelBox{} : grown(box, 1, camera_.width_px(), camera_.height_px());
}

void MarkCovers::add(const Actor& actor, int number) {
  const Mark& mark = actor.scene->model().marks[static_cast<std::size_t>(number)];
  const Pose& middle = actor.pose(camera_.height_px() / 2);
  const Vector3d to_eye = camera_.centre_m() - middle.to_world(mark.centre_m);
  if (!((middle.rotation * mark.normal).dot(to_eye) > 0.0)) return;
  PixelBox box = box_of(actor, mark, camera_.height_px() / 2);
  if (actor.poses.size() > 1 && !box.empty()) {
    box = around(box_of(actor, mark, box.y0), box_of(actor, mark, box.y1 - 1));
    box = grown(box, 2, camera_.width_px(), camera_.height_px());
  }
  const int thing = thing_of(actor.number, static_cast<int>(mark.part));
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      if (!rays_.seen(x, y)) continue;
      const double covered = share(actor.pose(y), mark, x, y);
      if (covered > 0.0) covers_.push_back({y * camera_.width_px() + x, thing, number, covered});
    }
  }
}

double MarkCovers::share(const Pose& pose, const Mark& mark, int x, int y) const {
  const Disc disc{pose.to_world(mark.centre_m), pose.rotation * mark.normal, mark.radius_m};
  const Vector3d origin = rays_.inside(x, y, 0.5, 0.5).origin;
  double sum = 0.0;
  for (int line = 0; line < kLines; ++line) {
    const double v = (line + 0.5) / kLines;
    const Vector3d left = rays_.inside(x, y, 0.0, v).direction;
    const Vector3d right = rays_.inside(x, y, 1.0, v).direction;
    sum += share_of_line(disc, origin, left, right - left);
  }
  return sum / kLines;
}

}  // namespace dottrack::host_sim
