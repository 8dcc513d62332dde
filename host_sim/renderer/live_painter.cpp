#include "host_sim/renderer/live_painter.h"

#include <algorithm>
#include <limits>

#include "host_sim/renderer/thresholds.h"
#include "host_sim/renderer/tile_sampler.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;
using Points = std::array<Vector3d, 4>;

constexpr unsigned kEdgeLooks = 8;
constexpr double kSameDistance = 1e-5;   // relative: what stands in a hit's own place
constexpr double kUnseen = 0.3 / 255.0;  // shadows that take away less are left out

std::size_t index_of(int thing) {
  return static_cast<std::size_t>(actor_of(thing) - kFirstBody);
}

unsigned hidden_by(const Actor& body, int y, const Vector3d& from, const Points& to) {
  const Pose& pose = body.pose(y);
  Points to_body;
  for (std::size_t i = 0; i < to.size(); ++i) to_body[i] = pose.to_body(to[i]);
  return body.scene->blocked(pose.to_body(from), to_body);
}

}  // namespace

LivePainter::LivePainter(const Stage& stage, const Levels& levels, const FloatImage& still,
                         std::span<const Actor> bodies)
    : stage_(stage),
      levels_(levels),
      still_(still),
      bodies_(bodies),
      marks_(bodies, stage.camera, stage.rays),
      shading_still_(stage.lamps.size()) {
  for (const Actor& shaded : bodies) {
    std::vector<Bodies>& by_lamp = shading_bodies_.emplace_back(stage.lamps.size());
    for (std::size_t i = 0; i < stage.lamps.size(); ++i) {
      for (const Actor& body : bodies) {
        if (&body == &shaded || may_hide(body.reach, shaded.reach, stage.lamps[i].reach)) {
          by_lamp[i].push_back(&body);
        }
      }
    }
  }
}

void LivePainter::find_bodies(const Tile& tile) {
  seen_.clear();
  for (const Actor& body : bodies_) {
    if (may_be_seen(body, tile)) seen_.push_back(&body);
  }
  shaded_ = false;
  for (std::size_t i = 0; i < stage_.lamps.size(); ++i) {
    shading_still_[i].clear();
    const int middle_row = (tile.box.y0 + tile.box.y1) / 2;
    if (static_cast<double>(tile.brightest[i]) * levels_.at(middle_row, i) < kUnseen) continue;
    for (const Actor& body : bodies_) {
      if (may_shade(body, tile, stage_.lamps[i])) shading_still_[i].push_back(&body);
    }
    shaded_ = shaded_ || !shading_still_[i].empty();
  }
}

bool LivePainter::paint(const Tile& tile, FloatImage& light) {
  find_bodies(tile);
  if (!seen_.empty()) {
    paint_seen(tile, light);
    return true;
  }
  if (!shaded_) return false;
  ShareLattice shares(tile.box, stage_.lamps.size(),
                      [&](int x, int y) { return still_look(x, y); });
  for (int y = tile.box.y0; y < tile.box.y1; ++y) {
    for (int x = tile.box.x0; x < tile.box.x1; ++x) {
      light.at(x - tile.box.x0, y - tile.box.y0) = static_cast<float>(still_light(x, y, shares));
    }
  }
  return true;
}

void LivePainter::paint_seen(const Tile& tile, FloatImage& light) {
  const auto cast = [this](const Sight& sight, int x, int y) { return look(sight, x, y); };
  const auto on_mark = [this](const MarkCover& cover, const Vector3d& p, int y) {
    const Actor& body = bodies_[index_of(cover.thing)];
    return host_sim::on_mark(body.scene->model().marks[static_cast<std::size_t>(cover.mark)],
                             body.pose(y).to_body(p));
  };
  const TileSampler sampler(stage_.rays, tile.box, marks_, kEdgeLooks, cast, on_mark);
  ShareLattice on_bodies(tile.box, stage_.lamps.size(),
                         [&](int x, int y) -> const Look& { return sampler.centre(x, y); });
  ShareLattice on_still(tile.box, stage_.lamps.size(),
                        [&](int x, int y) { return still_look(x, y); });
  Patches patches;
  for (int y = tile.box.y0; y < tile.box.y1; ++y) {
    for (int x = tile.box.x0; x < tile.box.x1; ++x) {
      double sum = 0.0;
      if (stage_.rays.seen(x, y)) {
        sampler.sample(x, y, patches, [](const Look&) {});
        for (const Patch& patch : patches) {
          sum += patch.share * (patch.look.thing == kNothing ? still_light(x, y, on_still)
                                                             : radiance(patch, x, y, on_bodies));
        }
      }
      light.at(x - tile.box.x0, y - tile.box.y0) = static_cast<float>(sum);
    }
  }
}

// The nearest body, unless the hall hides it; kNothing stands for the still picture.
Look LivePainter::look(const Sight& sight, int x, int y) const {
  Look nearest;
  for (const Actor* body : seen_) {
    const Pose& pose = body->pose(y);
    const RayHit hit = body->scene->meet(
        pose.to_body(sight.origin), pose.rotation.transpose() * sight.direction, nearest.distance);
    if (hit.part < 0 || !(hit.distance < nearest.distance)) continue;
    nearest.thing = thing_of(body->number, hit.part);
    nearest.distance = hit.distance;
    nearest.normal = pose.rotation * hit.normal;
  }
  if (nearest.thing == kNothing) return nearest;
  if (hidden_by_hall(sight, nearest.distance, x, y)) return {};
  nearest.point = sight.origin + nearest.distance * sight.direction;
  return nearest;
}

bool LivePainter::hidden_by_hall(const Sight& sight, double distance, int x, int y) const {
  const StillPoint& still = stage_.backdrop.points.at(x, y);
  if (distance < (1.0 - kSameDistance) * static_cast<double>(still.nearest)) return false;
  if (distance > (1.0 + kSameDistance) * static_cast<double>(still.farthest)) return true;
  const double farthest = (1.0 - kSameDistance) * distance;
  return stage_.hall.scene->meet(sight.origin, sight.direction, farthest).part >= 0;
}

double LivePainter::radiance(const Patch& patch, int x, int y, ShareLattice& shares) {
  const Actor& body = bodies_[index_of(patch.look.thing)];
  const Finish finish =
      finish_of(patch, body, body.pose(y), patch.look.distance * pixel_width(stage_.rays, x, y));
  unshadowed(finish, patch.look.point, stage_.camera.centre_m(), stage_.lamps, radiance_);
  double bounce = 0.0;
  for (std::size_t i = 0; i < radiance_.size(); ++i) {
    const double level = levels_.at(y, i);
    radiance_[i] *= level;
    bounce += level * stage_.lamps[i].bounce;
  }
  double sum = bounce * bounced(finish);
  if (finish.lamp >= 0) {
    sum += levels_.at(y, static_cast<std::size_t>(finish.lamp)) * finish.emission;
  }
  const double faint = faint_radiance(radiance_);
  const auto cell = shares.cell(x, y, patch.look);
  for (std::size_t i = 0; i < radiance_.size(); ++i) {
    double share = 1.0;
    if (radiance_[i] > faint) {
      const auto between = cell ? shares.share(*cell, i, kEvenRadiance / radiance_[i],
                                               [&](const Look& node, int row) {
                                                 return share_for_body(node, i, row);
                                               })
                                : std::nullopt;
      share = between ? *between : share_for_body(patch.look, i, y);
    }
    sum += share * radiance_[i];
  }
  return sum;
}

double LivePainter::share_for_body(const Look& from, std::size_t lamp, int y) const {
  const Vector3d p = off_surface(from);
  const Bodies& shading = shading_bodies_[index_of(from.thing)][lamp];
  return share_in_sight(stage_.lamps[lamp], [&](const Points& points) {
    unsigned hidden = 0;
    for (const Actor* body : shading) {
      if (hidden != 0xFU) hidden |= hidden_by(*body, y, p, points);
    }
    return hidden == 0xFU ? hidden : hidden | stage_.hall.scene->blocked(p, points);
  });
}

Look LivePainter::still_look(int x, int y) const {
  const StillPoint& still = stage_.backdrop.points.at(x, y);
  if (still.thing == kNothing) return {};
  const Sight sight = stage_.rays.inside(x, y, 0.5, 0.5);
  const auto distance = static_cast<double>(still.distance);
  return {still.thing, distance, sight.origin + distance * sight.direction,
          still.normal.cast<double>()};
}

// The still picture less what the bodies keep from it.
double LivePainter::still_light(int x, int y, ShareLattice& shares) {
  auto light = static_cast<double>(still_.at(x, y));
  if (!shaded_) return light;
  const Look here = still_look(x, y);
  if (here.thing == kNothing) return light;
  const auto cell = shares.cell(x, y, here);
  for (std::size_t i = 0; i < stage_.lamps.size(); ++i) {
    if (shading_still_[i].empty()) continue;
    const double direct =
        levels_.at(y, i) * static_cast<double>(stage_.backdrop.direct[i].at(x, y));
    if (direct < kUnseen) continue;
    const auto between =
        cell
            ? shares.share(*cell, i, kEvenRadiance / direct,
                           [&](const Look& node, int row) { return share_for_still(node, i, row); })
            : std::nullopt;
    light -= direct * (1.0 - (between ? *between : share_for_still(here, i, y)));
  }
  return light;
}

double LivePainter::share_for_still(const Look& from, std::size_t lamp, int y) const {
  const Vector3d p = off_surface(from);
  return share_in_sight(stage_.lamps[lamp], [&](const Points& points) {
    unsigned hidden = 0;
    for (const Actor* body : shading_still_[lamp]) hidden |= hidden_by(*body, y, p, points);
    return hidden;
  });
}

}  // namespace dottrack::host_sim
