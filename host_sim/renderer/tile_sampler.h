#pragma once
// How much of each pixel of a tile each face covers: five looks where all is one face, many where
// an edge crosses, and for marks their exact share.

#include <cstddef>
#include <vector>

#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/mark_covers.h"
#include "host_sim/renderer/patch.h"
#include "host_sim/renderer/ray_lattice.h"

namespace dottrack::host_sim {

// Where to look in a pixel that an edge crosses: n points (a power of 2), none in the column or
// row of another, so that upright and level edges are as smooth as oblique ones.
inline Eigen::Vector2d spread_look(unsigned i, unsigned n) {
  unsigned reversed = 0;
  for (unsigned bit = 1; bit < n; bit *= 2) reversed = 2 * reversed + ((i & bit) != 0 ? 1 : 0);
  return Eigen::Vector2d(i + 0.5, reversed + 0.5) / n;
}

// Cast: Look operator()(const Sight& sight, int x, int y) const, for a line through pixel (x, y).
// OnMark: bool operator()(const MarkCover& cover, const Eigen::Vector3d& p_world, int y) const.
template <class Cast, class OnMark>
class TileSampler {
 public:
  TileSampler(const RayLattice& rays, const PixelBox& tile, const MarkCovers& marks,
              unsigned edge_looks, const Cast& cast, const OnMark& on_mark)
      : rays_(rays),
        tile_(tile),
        marks_(marks),
        edge_looks_(edge_looks),
        cast_(cast),
        on_mark_(on_mark),
        corners_(tile.x1 - tile.x0 + 1, tile.y1 - tile.y0 + 1),
        centres_(tile.x1 - tile.x0, tile.y1 - tile.y0) {
    for (int y = tile.y0; y <= tile.y1; ++y) {
      for (int x = tile.x0; x <= tile.x1; ++x) {
        const Sight sight = rays.corner(x, y);
        if (sight.direction.isZero(0.0)) continue;
        corners_.at(x - tile.x0, y - tile.y0) =
            cast(sight, x < tile.x1 ? x : x - 1, y < tile.y1 ? y : y - 1);
      }
    }
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        if (rays.seen(x, y)) centre(x, y) = cast(rays.inside(x, y, 0.5, 0.5), x, y);
      }
    }
  }

  const Look& centre(int x, int y) const { return centres_.at(x - tile_.x0, y - tile_.y0); }
  // The corner at (x - 0.5, y - 0.5).
  const Look& corner(int x, int y) const { return corners_.at(x - tile_.x0, y - tile_.y0); }

  // What pixel (x, y), which the lens sees, shows; shares add up to 1. `each` is shown every look.
  template <class Each>
  void sample(int x, int y, Patches& patches, const Each& each) const {
    patches.clear();
    const Look& middle = centre(x, y);
    bool uniform = true;
    for (const Look* look :
         {&middle, &corner(x, y), &corner(x + 1, y), &corner(x, y + 1), &corner(x + 1, y + 1)}) {
      uniform = uniform && same_face(middle, *look);
      each(*look);
    }
    if (uniform) {
      paint(middle, x, y, patches);
    } else {
      divide(x, y, patches, each);
    }
  }

 private:
  static constexpr unsigned kFineGrid = 16;  // 16 x 16 looks

  Look& centre(int x, int y) { return centres_.at(x - tile_.x0, y - tile_.y0); }

  // All of the pixel is one face: the marks on it by their exact shares.
  void paint(const Look& face, int x, int y, Patches& patches) const {
    double bare = 1.0;
    if (face.thing != kNothing) {
      for (const MarkCover& cover : marks_.at(x, y)) {
        if (cover.thing != face.thing || patches.size() + 1 == patches.capacity()) continue;
        patches.push_back({face, cover.mark, cover.share});
        bare -= cover.share;
      }
    }
    if (bare > 1e-6) patches.push_back({face, -1, bare});
  }

  template <class Each>
  void divide(int x, int y, Patches& patches, const Each& each) const {
    const auto marks = marks_.at(x, y);
    const unsigned looks = marks.empty() ? edge_looks_ : kFineGrid * kFineGrid;
    for (unsigned i = 0; i < looks; ++i) {
      const Eigen::Vector2d at = spread_look(i, looks);
      const Look look = cast_(rays_.inside(x, y, at.x(), at.y()), x, y);
      each(look);
      int mark = -1;
      for (const MarkCover& cover : marks) {
        if (cover.thing == look.thing && on_mark_(cover, look.point, y)) mark = cover.mark;
      }
      add(look, mark, patches);
    }
    for (Patch& patch : patches) {  // shares are numbers of looks so far
      patch.look.point /= patch.share;
      patch.look.distance /= patch.share;
      patch.share /= looks;
    }
  }

  // A face beyond the capacity is counted with the last one.
  static void add(const Look& look, int mark, Patches& patches) {
    std::size_t i = 0;
    while (i < patches.size() && (patches[i].mark != mark || !same_face(patches[i].look, look))) {
      ++i;
    }
    if (i == patches.size()) {
      if (i < patches.capacity()) {
        patches.push_back({look, mark, 1.0});
        return;
      }
      --i;
    }
    patches[i].look.point += look.point;
    patches[i].look.distance += look.distance;
    patches[i].share += 1.0;
  }

  const RayLattice& rays_;
  PixelBox tile_;
  const MarkCovers& marks_;
  unsigned edge_looks_;
  const Cast& cast_;
  const OnMark& on_mark_;
  ImageBuffer<Look> corners_;
  ImageBuffer<Look> centres_;
};

}  // namespace dottrack::host_sim
