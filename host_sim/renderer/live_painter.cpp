#include "host_sim/renderer/live_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "host_sim/renderer/thresholds.h"
#include "host_sim/renderer/tile_sampler.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;
using Points = std::array<Vector3d, 4>;

constexpr double kSameDistance = 1e-5;  // relative: what stands in a hit's own place

// Of every how many nodes: a weak lamp's shadow from every second where these agree.
std::span<const std::size_t> strides(bool strong) {
  static constexpr std::array<std::size_t, 2> kStrides{2, 1};
  return std::span(kStrides).subspan(strong ? 1 : 0);
}

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

const Care& full_care() {
  static constexpr Care kCare{.edge_looks = 8,
                              .every_pixel = true,
                              .strong = 14.0 / 255.0,
                              .faint = 0.04,
                              .faint_on_still = 0.015,
                              .unseen = 0.3 / 255.0,
                              .tolerance = kEvenRadiance};
  return kCare;
}

const Care& quick_care() {
  static constexpr Care kCare{.edge_looks = 4,
                              .every_pixel = false,
                              .strong = 90.0 / 255.0,
                              .faint = 0.2,
                              .faint_on_still = 0.12,
                              .unseen = 10.0 / 255.0,
                              .tolerance = 8.0 / 255.0};
  return kCare;
}

LivePainter::LivePainter(const Stage& stage, const Levels& levels, const FloatImage& still,
                         std::span<const Actor> bodies, ShareLattice& still_shares,
                         const Care& care)
    : stage_(stage),
      levels_(levels),
      still_(still),
      bodies_(bodies),
      still_shares_(still_shares),
      care_(care),
      marks_(bodies, stage.camera, stage.rays),
      face_shares_(stage.lamps.size()) {
  still_shares_.forget();
  for (const Actor& shaded : bodies) {
    std::vector<bool>& clear = hall_is_clear_.emplace_back();
    for (const LampLight& lamp : stage.lamps) clear.push_back(clear_of_hall(shaded, lamp));
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

// Whether the hall keeps nothing of the lamp from 27 points all over the body's box.
bool LivePainter::clear_of_hall(const Actor& body, const LampLight& lamp) const {
  const Vector3d& low = body.scene->low();
  const Vector3d half = 0.5 * (body.scene->high() - low);
  const Pose& pose = body.pose(stage_.camera.height_px() / 2);
  for (int i = 0; i < 9; ++i) {
    const int row = i / 3;
    // The lowest are off what the body stands on.
    for (const double height : {0.1, 1.05, 2.0}) {
      const Vector3d at = low + half.cwiseProduct(Vector3d(i % 3, row, height));
      if (stage_.hall.scene->blocked(pose.to_world(at), lamp.points[0]) != 0U) return false;
    }
  }
  return true;
}

void LivePainter::find_bodies(const Tile& tile) {
  seen_.clear();
  for (const Actor& body : bodies_) {
    if (may_be_seen(body, tile)) seen_.push_back(&body);
  }
  find_shadows(tile);
}

void LivePainter::find_shadows(const Tile& tile) {
  shaded_ = false;
  for (auto& lamps : shaded_lamps_) lamps.clear();
  const int middle_row = (tile.box.y0 + tile.box.y1) / 2;
  for (std::size_t i = 0; i < stage_.lamps.size(); ++i) {
    const double brightest = static_cast<double>(tile.brightest[i]) * levels_.at(middle_row, i);
    if (brightest < care_.unseen) continue;
    const LampLight& lamp = stage_.lamps[i];
    if (std::none_of(bodies_.begin(), bodies_.end(),
                     [&](const Actor& body) { return may_shade(body, tile, lamp); })) {
      continue;
    }
    for (int y = tile.box.y0; y < tile.box.y1; y += kBlock_px) {
      for (int x = tile.box.x0; x < tile.box.x1; x += kBlock_px) {
        if (all_lit(x, y, i, brightest > care_.strong)) continue;
        shaded_lamps_[block_of(tile, x, y)].push_back(i);
        shaded_ = true;
      }
    }
  }
}

// Whether no body keeps the lamp from any node of the block that begins at (x, y).
bool LivePainter::all_lit(int x, int y, std::size_t lamp, bool strong) {
  const int step_px = strong ? kBlock_px / 2 : kBlock_px;
  for (int dy = 0; dy < kBlock_px; dy += step_px) {
    for (int dx = 0; dx < kBlock_px; dx += step_px) {
      const int at_x = std::min(x + dx, stage_.camera.width_px() - 1);
      const int at_y = std::min(y + dy, stage_.camera.height_px() - 1);
      const auto at = shares_at(still_shares_.cell(at_x, at_y, strong ? 1 : 2), lamp, strong);
      if (std::any_of(at.begin(), at.end(), [](double share) { return share < 1.0; })) return false;
    }
  }
  return true;
}

ShareLattice::Shares LivePainter::shares_at(const ShareLattice::Cell& cell, std::size_t lamp,
                                            bool strong) {
  return still_shares_.at(cell, lamp, [&](const Look& node, int row) {
    return node.thing == kNothing ? 1.0 : share_for_still(node, lamp, row, strong);
  });
}

bool LivePainter::paint(const Tile& tile, FloatImage& light) {
  find_bodies(tile);
  if (!seen_.empty()) {
    paint_seen(tile, light);
    return true;
  }
  if (!shaded_) return false;
  for (int y = tile.box.y0; y < tile.box.y1; ++y) {
    for (int x = tile.box.x0; x < tile.box.x1; ++x) {
      light.at(x - tile.box.x0, y - tile.box.y0) = static_cast<float>(still_light(tile, x, y));
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
  const TileSampler sampler(stage_.rays, tile.box, marks_, care_.edge_looks, cast, on_mark,
                            care_.every_pixel);
  ShareLattice on_bodies(tile.box, stage_.lamps.size(),
                         [&](int x, int y) -> const Look& { return sampler.centre(x, y); });
  face_shares_.forget();
  Patches patches;
  const Even none{};
  std::array<Even, TileIndex::kTile_px / 2> evens{};  // of a row of blocks of 2 x 2 pixels
  for (int y = tile.box.y0; y < tile.box.y1; ++y) {
    if ((y - tile.box.y0) % 2 == 0) evens.fill(none);
    for (int x = tile.box.x0; x < tile.box.x1; ++x) {
      Even& even = evens[static_cast<std::size_t>(x - tile.box.x0) / 2];
      double sum = 0.0;
      if (stage_.rays.seen(x, y)) {
        sampler.sample(x, y, patches, [](const Look&) {});
        for (const Patch& patch : patches) {
          sum +=
              patch.share * (patch.look.thing == kNothing ? still_light(tile, x, y)
                                                          : shaded(patch, x, y, on_bodies, even));
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

// Where not every pixel is asked for, a bare face that fills a pixel lends its radiance to those of
// its block that it fills too.
double LivePainter::shaded(const Patch& patch, int x, int y, ShareLattice& shares, Even& even) {
  if (care_.every_pixel || patch.mark >= 0 || patch.share < 1.0) {
    return radiance(patch, x, y, shares);
  }
  if (even.look.thing == kNothing || !same_face(even.look, patch.look)) {
    even = {patch.look, radiance(patch, x, y, shares)};
  }
  return even.radiance;
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
  const double faint = care_.faint * std::accumulate(radiance_.begin(), radiance_.end(), 0.0);
  double faintly = 0.0;
  double strongly = 0.0;
  double seen = 0.0;
  for (std::size_t i = 0; i < radiance_.size(); ++i) {
    if (radiance_[i] > faint) {
      strongly += radiance_[i];
      seen += radiance_[i] * share_of_patch(patch, i, x, y, shares);
    } else {
      faintly += radiance_[i];
    }
  }
  return sum + seen + (strongly > 0.0 ? faintly * seen / strongly : faintly);
}

double LivePainter::tolerance_of(bool strong, std::size_t stride) const {
  return !strong && stride == 1 ? 2.0 * care_.tolerance : care_.tolerance;
}

double LivePainter::share_of_patch(const Patch& patch, std::size_t lamp, int x, int y,
                                   ShareLattice& shares) {
  const bool strong = radiance_[lamp] > care_.strong;
  for (const std::size_t stride : strides(strong)) {
    const auto cell = shares.cell(x, y, stride);
    if (!shares.same_face_around(cell, patch.look)) continue;
    const auto at = shares.at(cell, lamp, [&](const Look& node, int row) {
      return share_for_body(node, lamp, row, strong);
    });
    const double tolerance = tolerance_of(strong, stride) / radiance_[lamp];
    if (const auto between = shares.between(cell, at, tolerance)) return *between;
  }
  if (strong) return share_for_body(patch.look, lamp, y, true);
  double& share = face_shares_.at(x, y, patch.look, lamp);
  if (std::isnan(share)) share = share_for_body(patch.look, lamp, y, false);
  return share;
}

double LivePainter::share_for_body(const Look& from, std::size_t lamp, int y, bool finely) const {
  const Vector3d p = off_surface(from);
  const Bodies& shading = shading_bodies_[index_of(from.thing)][lamp];
  const bool clear = !finely && hall_is_clear_[index_of(from.thing)][lamp];
  return share_in_sight(stage_.lamps[lamp], finely, [&](const Points& points) {
    unsigned hidden = 0;
    for (const Actor* body : shading) {
      if (hidden != 0xFU) hidden |= hidden_by(*body, y, p, points);
    }
    return clear || hidden == 0xFU ? hidden : hidden | stage_.hall.scene->blocked(p, points);
  });
}

// The still picture less what the bodies keep from it.
double LivePainter::still_light(const Tile& tile, int x, int y) {
  auto light = static_cast<double>(still_.at(x, y));
  const std::vector<std::size_t>& lamps = shaded_lamps_[block_of(tile, x, y)];
  if (lamps.empty() || stage_.backdrop.points.at(x, y).thing == kNothing) return light;
  const Look here = still_look(stage_.backdrop, stage_.rays, x, y);
  for (const std::size_t i : lamps) {
    const double direct =
        levels_.at(y, i) * static_cast<double>(stage_.backdrop.direct[i].at(x, y));
    if (direct > std::max(care_.unseen, care_.faint_on_still * light))
      light -= direct * (1.0 - share_of_still(here, i, direct, x, y));
  }
  return light;
}

double LivePainter::share_of_still(const Look& here, std::size_t lamp, double direct, int x,
                                   int y) {
  const bool strong = direct > care_.strong;
  for (const std::size_t stride : strides(strong)) {
    const auto cell = still_shares_.cell(x, y, stride);
    const auto at = shares_at(cell, lamp, strong);
    if (std::all_of(at.begin(), at.end(), [](double share) { return share == 1.0; })) return 1.0;
    if (strong && !still_shares_.same_face_around(cell, here)) continue;
    const double tolerance = tolerance_of(strong, stride) / direct;
    if (const auto between = still_shares_.between(cell, at, tolerance)) return *between;
  }
  return share_for_still(here, lamp, y, strong);
}

double LivePainter::share_for_still(const Look& from, std::size_t lamp, int y, bool finely) {
  const Vector3d p = off_surface(from);
  near_.clear();
  for (const Actor& body : bodies_) {
    if (may_hide(body.reach, {p, 0.0}, stage_.lamps[lamp].reach)) near_.push_back(&body);
  }
  if (near_.empty()) return 1.0;
  return share_in_sight(stage_.lamps[lamp], finely, [&](const Points& points) {
    unsigned hidden = 0;
    for (const Actor* body : near_) hidden |= hidden_by(*body, y, p, points);
    return hidden;
  });
}

}  // namespace dottrack::host_sim
