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
  // every_pixel false: blocks of 4 x 4 and 2 x 2 pixels whose corners and middle show one face are
  // filled in from these, at a small part of the cost; what is narrower may be missed.
  TileSampler(const RayLattice& rays, const PixelBox& tile, const MarkCovers& marks,
              unsigned edge_looks, const Cast& cast, const OnMark& on_mark, bool every_pixel = true)
      : rays_(rays),
        tile_(tile),
        marks_(marks),
        edge_looks_(edge_looks),
        mark_looks_(every_pixel ? kFineLooks : kQuickLooks),
        cast_(cast),
        on_mark_(on_mark),
        corners_(tile.x1 - tile.x0 + 1, tile.y1 - tile.y0 + 1),
        centres_(tile.x1 - tile.x0, tile.y1 - tile.y0) {
    const bool in_blocks = (tile.x1 - tile.x0) % 2 == 0 && (tile.y1 - tile.y0) % 2 == 0;
    if (every_pixel || !in_blocks) {
      look_everywhere();
    } else {
      look_by_blocks();
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
  // Looks in a pixel that an edge crosses and that has marks: 16 x 16 or 8 x 8.
  static constexpr unsigned kFineLooks = 256;
  static constexpr unsigned kQuickLooks = 64;

  Look& centre(int x, int y) { return centres_.at(x - tile_.x0, y - tile_.y0); }
  Look& corner(int x, int y) { return corners_.at(x - tile_.x0, y - tile_.y0); }

  void look_at_corner(int x, int y) {
    const Sight sight = rays_.corner(x, y);
    if (sight.direction.isZero(0.0)) return;
    corner(x, y) = cast_(sight, x < tile_.x1 ? x : x - 1, y < tile_.y1 ? y : y - 1);
  }

  void look_at_centre(int x, int y) {
    if (rays_.seen(x, y)) centre(x, y) = cast_(rays_.inside(x, y, 0.5, 0.5), x, y);
  }

  void look_everywhere() {
    for (int y = tile_.y0; y <= tile_.y1; ++y) {
      for (int x = tile_.x0; x <= tile_.x1; ++x) look_at_corner(x, y);
    }
    for (int y = tile_.y0; y < tile_.y1; ++y) {
      for (int x = tile_.x0; x < tile_.x1; ++x) look_at_centre(x, y);
    }
  }

  // Blocks of 4 x 4 pixels first, where one face fills them; then those of 2 x 2 in the others.
  void look_by_blocks() {
    const auto lattice = [&](int step, int first_x, int first_y) {
      for (int y = tile_.y0 + first_y; y <= tile_.y1; y += step) {
        for (int x = tile_.x0 + first_x; x <= tile_.x1; x += step) look_at_corner(x, y);
      }
    };
    lattice(4, 0, 0);
    lattice(4, 2, 2);
    for (int y = tile_.y0; y < tile_.y1; y += 4) {
      for (int x = tile_.x0; x < tile_.x1; x += 4) fill_large_block(x, y);
    }
  }

  // Bare space is not taken on trust: a thin thing may stand in it.
  void fill_large_block(int x, int y) {
    const bool full = x + 4 <= tile_.x1 && y + 4 <= tile_.y1;
    const bool one_face =
        full && corner(x + 2, y + 2).thing != kNothing && one_face_around(x, y, 4);
    for (const int dy : {0, 4})
      set_if_inside(x + 2, y + dy, one_face, {x, y + dy}, {x + 4, y + dy});
    for (const int dx : {0, 4})
      set_if_inside(x + dx, y + 2, one_face, {x + dx, y}, {x + dx, y + 4});
    for (int dy = 0; dy < 4 && y + dy < tile_.y1; dy += 2) {
      for (int dx = 0; dx < 4 && x + dx < tile_.x1; dx += 2) {
        Look& middle = corner(x + dx + 1, y + dy + 1);
        if (one_face) {
          middle = between(corner(x + 2, y + 2), corner(x + 2 * dx, y + 2 * dy));
        } else {
          look_at_corner(x + dx + 1, y + dy + 1);
        }
        fill_block(x + dx, y + dy);
      }
    }
  }

  struct At {
    int x;
    int y;
  };
  void set_if_inside(int x, int y, bool one_face, At a, At b) {
    if (x <= tile_.x1 && y <= tile_.y1) set(x, y, one_face, a, b);
  }

  bool one_face_around(int x, int y, int size) const {
    const Look& middle = corner(x + size / 2, y + size / 2);
    return same_face(middle, corner(x, y)) && same_face(middle, corner(x + size, y)) &&
           same_face(middle, corner(x, y + size)) && same_face(middle, corner(x + size, y + size));
  }

  void fill_block(int x, int y) {
    const bool one_face = one_face_around(x, y, 2);
    for (const int dy : {0, 2}) set(x + 1, y + dy, one_face, {x, y + dy}, {x + 2, y + dy});
    for (const int dx : {0, 2}) set(x + dx, y + 1, one_face, {x + dx, y}, {x + dx, y + 2});
    for (int dy = 0; dy < 2; ++dy) {
      for (int dx = 0; dx < 2; ++dx) {
        if (one_face) {
          centre(x + dx, y + dy) = between(corner(x + 1, y + 1), corner(x + 2 * dx, y + 2 * dy));
        } else {
          look_at_centre(x + dx, y + dy);
        }
      }
    }
  }

  // The corner at the middle of a block's side. A block that is not of one face looks for itself
  // and has the last word where its neighbour has only guessed.
  void set(int x, int y, bool one_face, At a, At b) {
    Look& here = corner(x, y);
    if (!one_face) {
      look_at_corner(x, y);
    } else if (here.thing == kNothing) {
      here = between(corner(a.x, a.y), corner(b.x, b.y));
    }
  }

  static Look between(const Look& a, const Look& b) {
    if (a.thing == kNothing) return {};
    return {a.thing, 0.5 * (a.distance + b.distance), 0.5 * (a.point + b.point),
            (a.normal + b.normal).normalized()};
  }

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
    const unsigned looks = marks.empty() ? edge_looks_ : mark_looks_;
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
  unsigned mark_looks_;
  const Cast& cast_;
  const OnMark& on_mark_;
  ImageBuffer<Look> corners_;
  ImageBuffer<Look> centres_;
};

}  // namespace dottrack::host_sim
