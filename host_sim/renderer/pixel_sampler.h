#pragma once
// How much of a pixel each surface covers: one look where all is one surface, many where an edge
// crosses, most where it is the edge of a dot. A dot's centroid then comes out within 0.006 px RMS
// of its projected outline's, the rounding to 8 bits included (measured on 115 oblique views).

#include <cstddef>

#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/patch.h"
#include "host_sim/renderer/ray_lattice.h"
#include "host_sim/renderer/surface.h"

namespace dottrack::host_sim {

// Cast: SurfaceHit(int x, int y, const Eigen::Vector3d& direction) const.
// IsMark: bool(int surface), true where edges must be exact.
template <class Cast, class IsMark>
class PixelSampler {
 public:
  PixelSampler(const RayLattice& rays, const PixelBox& box, const Cast& cast, const IsMark& is_mark)
      : rays_(rays), box_(box), cast_(cast), is_mark_(is_mark) {
    corners_ = ImageBuffer<int>(box.x1 - box.x0 + 1, box.y1 - box.y0 + 1, kNothing);
    for (int y = box.y0; y <= box.y1; ++y) {
      for (int x = box.x0; x <= box.x1; ++x) corners_.at(x - box.x0, y - box.y0) = look(x, y);
    }
  }

  // The surfaces in pixel (x, y) of the box; shares add up to 1.
  void sample(int x, int y, Patches& patches) const {
    patches.clear();
    const Neighbourhood near = around(x, y);
    const Eigen::Vector3d middle = rays_.inside(x, y, 0.5, 0.5);
    const SurfaceHit hit = cast_(x, y, middle);
    if (near.uniform && hit.surface == near.surface) {
      patches.push_back({hit.surface, 1, 1.0, middle, hit.normal, hit.distance});
      return;
    }
    divide(x, y, near.has_mark || is_mark_(hit.surface) ? kFineGrid : kCoarseGrid, patches);
  }

 private:
  static constexpr int kCoarseGrid = 4;
  static constexpr int kFineGrid = 16;

  struct Neighbourhood {
    int surface = kNothing;
    bool uniform = true;
    bool has_mark = false;
  };

  int look(int x, int y) const {
    const int pixel_x = x < box_.x1 ? x : x - 1;  // a pixel that this corner belongs to
    const int pixel_y = y < box_.y1 ? y : y - 1;
    return cast_(pixel_x, pixel_y, rays_.corner(x, y)).surface;
  }

  // The corners of the pixel and of its neighbours: an edge may cross a pixel between its corners.
  Neighbourhood around(int x, int y) const {
    Neighbourhood near;
    near.surface = corners_.at(x - box_.x0, y - box_.y0);
    const PixelBox b = grown({x - box_.x0, y - box_.y0, x - box_.x0 + 2, y - box_.y0 + 2}, 1,
                             corners_.width_px(), corners_.height_px());
    for (int cy = b.y0; cy < b.y1; ++cy) {
      for (int cx = b.x0; cx < b.x1; ++cx) {
        const int surface = corners_.at(cx, cy);
        near.uniform = near.uniform && surface == near.surface;
        near.has_mark = near.has_mark || is_mark_(surface);
      }
    }
    return near;
  }

  void divide(int x, int y, int grid, Patches& patches) const {
    for (int j = 0; j < grid; ++j) {
      for (int i = 0; i < grid; ++i) {
        const Eigen::Vector3d direction = rays_.inside(x, y, (i + 0.5) / grid, (j + 0.5) / grid);
        add_look(cast_(x, y, direction), direction, patches);
      }
    }
    for (Patch& patch : patches) {
      const double looks = patch.looks;
      patch.share = looks / (grid * grid);
      patch.direction /= looks;
      patch.distance /= looks;
    }
  }

  // A surface beyond the capacity is counted with the last one.
  static void add_look(const SurfaceHit& hit, const Eigen::Vector3d& direction, Patches& patches) {
    std::size_t i = 0;
    while (i < patches.size() && patches[i].surface != hit.surface) ++i;
    if (i == patches.size() && i < patches.capacity()) {
      patches.push_back({hit.surface, 0, 0.0, Eigen::Vector3d::Zero(), hit.normal, 0.0});
    }
    if (i == patches.capacity())
      return add_look({patches.back().surface, hit.distance, hit.normal}, direction, patches);
    patches[i].looks += 1;
    patches[i].direction += direction;
    patches[i].distance += hit.distance;
  }

  const RayLattice& rays_;
  PixelBox box_;
  const Cast& cast_;
  const IsMark& is_mark_;
  ImageBuffer<int> corners_;
};

}  // namespace dottrack::host_sim
