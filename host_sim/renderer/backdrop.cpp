#include "host_sim/renderer/backdrop.h"

#include <algorithm>
#include <utility>

#include "host_sim/renderer/mark_covers.h"
#include "host_sim/renderer/shading.h"
#include "host_sim/renderer/share_lattice.h"
#include "host_sim/renderer/thresholds.h"
#include "host_sim/renderer/tile_sampler.h"

namespace dottrack::host_sim {
namespace {

constexpr int kTile_px = 32;
constexpr unsigned kEdgeLooks = 16;

class Painter {
 public:
  Painter(const Actor& hall, std::span<const LampLight> lamps, const SimCamera& camera,
          const RayLattice& rays)
      : hall_(hall), lamps_(lamps), rays_(rays), marks_({&hall, 1}, camera, rays) {
    const int width_px = camera.width_px();
    const int height_px = camera.height_px();
    picture_.direct.assign(lamps.size(), FloatImage(width_px, height_px));
    picture_.bounced = FloatImage(width_px, height_px);
    picture_.points = ImageBuffer<StillPoint>(width_px, height_px);
  }

  void paint_tile(const PixelBox& tile) {
    const auto cast = [this](const Sight& sight, int, int) { return look(sight); };
    const auto on_mark = [this](const MarkCover& cover, const Eigen::Vector3d& p, int) {
      return host_sim::on_mark(hall_.scene->model().marks[static_cast<std::size_t>(cover.mark)], p);
    };
    const TileSampler sampler(rays_, tile, marks_, kEdgeLooks, cast, on_mark);
    ShareLattice shares(tile, lamps_.size(),
                        [&](int x, int y) -> const Look& { return sampler.centre(x, y); });
    Patches patches;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        if (!rays_.seen(x, y)) continue;
        StillPoint& point = picture_.points.at(x, y);
        sampler.sample(x, y, patches, [&](const Look& seen) {
          point.nearest = std::min(point.nearest, static_cast<float>(seen.distance));
          point.farthest = std::max(point.farthest, static_cast<float>(seen.distance));
        });
        note_largest(patches, point);
        for (const Patch& patch : patches) paint(patch, x, y, shares);
      }
    }
  }

  Backdrop take() { return std::move(picture_); }

 private:
  Look look(const Sight& sight) const {
    const RayHit hit =
        hall_.scene->meet(sight.origin, sight.direction, std::numeric_limits<double>::infinity());
    if (hit.part < 0) return {};
    return {thing_of(hall_.number, hit.part), hit.distance,
            sight.origin + hit.distance * sight.direction, hit.normal};
  }

  static void note_largest(const Patches& patches, StillPoint& point) {
    const auto largest =
        std::max_element(patches.begin(), patches.end(),
                         [](const Patch& a, const Patch& b) { return a.share < b.share; });
    point.distance = static_cast<float>(largest->look.distance);
    point.thing = largest->look.thing;
    point.normal = largest->look.normal.cast<float>();
  }

  double share_in_sight(const Look& from, std::size_t lamp) const {
    const Eigen::Vector3d p = off_surface(from);
    return host_sim::share_in_sight(
        lamps_[lamp], true, [&](const auto& points) { return hall_.scene->blocked(p, points); });
  }

  void paint(const Patch& patch, int x, int y, ShareLattice& shares) {
    if (patch.look.thing == kNothing) return;
    const Sight sight = rays_.inside(x, y, 0.5, 0.5);
    const Finish finish =
        finish_of(patch, hall_, hall_.pose(y), patch.look.distance * pixel_width(rays_, x, y));
    picture_.bounced.at(x, y) += static_cast<float>(patch.share * bounced(finish));
    if (finish.lamp >= 0 && finish.emission > 0.0) {
      picture_.glow.push_back({x, y, static_cast<std::size_t>(finish.lamp),
                               static_cast<float>(patch.share * finish.emission)});
    }
    unshadowed(finish, patch.look.point, sight.origin, lamps_, radiance_);
    const double faint = faint_radiance(radiance_);
    const auto cell = shares.cell(x, y);
    const bool even = shares.same_face_around(cell, patch.look);
    const auto find = [&](std::size_t lamp) {
      return [this, lamp](const Look& node, int) { return share_in_sight(node, lamp); };
    };
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
      double share = 1.0;
      if (radiance_[i] > faint) {
        const auto between =
            even ? shares.between(cell, shares.at(cell, i, find(i)), kEvenRadiance / radiance_[i])
                 : std::nullopt;
        share = between ? *between : share_in_sight(patch.look, i);
      }
      picture_.direct[i].at(x, y) += static_cast<float>(patch.share * share * radiance_[i]);
    }
  }

  const Actor& hall_;
  std::span<const LampLight> lamps_;
  const RayLattice& rays_;
  MarkCovers marks_;
  Backdrop picture_;
  std::vector<double> radiance_;  // of one patch, by lamp
};

}  // namespace

Look still_look(const Backdrop& backdrop, const RayLattice& rays, int x, int y) {
  const StillPoint& still = backdrop.points.at(x, y);
  if (still.thing == kNothing) return {};
  const Sight sight = rays.inside(x, y, 0.5, 0.5);
  const auto distance = static_cast<double>(still.distance);
  return {still.thing, distance, sight.origin + distance * sight.direction,
          still.normal.cast<double>()};
}

Backdrop paint_backdrop(const Actor& hall, std::span<const LampLight> lamps,
                        const SimCamera& camera, const RayLattice& rays) {
  Painter painter(hall, lamps, camera, rays);
  for (int y = 0; y < camera.height_px(); y += kTile_px) {
    for (int x = 0; x < camera.width_px(); x += kTile_px) {
      painter.paint_tile({x, y, std::min(x + kTile_px, camera.width_px()),
                          std::min(y + kTile_px, camera.height_px())});
    }
  }
  return painter.take();
}

}  // namespace dottrack::host_sim
