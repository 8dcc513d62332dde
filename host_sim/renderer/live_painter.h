#pragma once
// The parts of a picture that bodies or their shadows touch, at one instant.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "host_sim/renderer/face_shares.h"
#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/mark_covers.h"
#include "host_sim/renderer/shading.h"
#include "host_sim/renderer/share_lattice.h"
#include "host_sim/renderer/shutter.h"
#include "host_sim/renderer/stage.h"

namespace dottrack::host_sim {

// What is worked out, and how finely. Radiance: 1 is 255 grey levels.
struct Care {
  unsigned edge_looks;  // in a pixel that an edge crosses
  bool every_pixel;     // else pixels of one face share looks and radiance in blocks
  double strong;        // lamps whose shadows must not be blocky
  // Shares of all light. Lamps that give a body less are taken to be hidden as the others are;
  // those that give less to what stands still throw no shadows on it.
  double faint;
  double faint_on_still;
  double unseen;     // shadows that take away less are left out
  double tolerance;  // shadows between nodes that agree within this are interpolated
};

const Care& full_care();
const Care& quick_care();

class LivePainter {
 public:
  // `still`: the picture without bodies, at these levels. All of them outlive this.
  // `still_shares`: a lattice over all of the still picture, which is used up.
  LivePainter(const Stage& stage, const Levels& levels, const FloatImage& still,
              std::span<const Actor> bodies, ShareLattice& still_shares, const Care& care);

  // The light of a tile's pixels in `light`, of the tile's size or larger; false, and nothing
  // written, where no body or shadow comes near.
  bool paint(const Tile& tile, FloatImage& light);

 private:
  static std::size_t block_of(const Tile& tile, int x, int y) {
    const int row = (y - tile.box.y0) / kBlock_px;
    const int column = (x - tile.box.x0) / kBlock_px;
    const int block = 2 * row + column;
    return static_cast<std::size_t>(block);
  }

  using Points = std::array<Eigen::Vector3d, 4>;
  using Bodies = std::vector<const Actor*>;
  static constexpr int kBlock_px = TileIndex::kTile_px / 2;

  bool clear_of_hall(const Actor& body, const LampLight& lamp) const;
  void find_bodies(const Tile& tile);
  void find_shadows(const Tile& tile);
  bool all_lit(int x, int y, std::size_t lamp, bool strong);
  void paint_seen(const Tile& tile, FloatImage& light);
  Look look(const Sight& sight, int x, int y) const;
  bool hidden_by_hall(const Sight& sight, double distance, int x, int y) const;
  // A face and what it sends to the eye.
  struct Even {
    Look look;
    double radiance = 0.0;
  };
  double shaded(const Patch& patch, int x, int y, ShareLattice& shares, Even& even);
  double radiance(const Patch& patch, int x, int y, ShareLattice& shares);
  double share_of_patch(const Patch& patch, std::size_t lamp, int x, int y, ShareLattice& shares);
  double share_for_body(const Look& from, std::size_t lamp, int y, bool finely) const;
  double still_light(const Tile& tile, int x, int y);
  ShareLattice::Shares shares_at(const ShareLattice::Cell& cell, std::size_t lamp, bool strong);
  double share_of_still(const Look& here, std::size_t lamp, double direct, int x, int y);
  double tolerance_of(bool strong, std::size_t stride) const;
  double share_for_still(const Look& from, std::size_t lamp, int y, bool finely);

  const Stage& stage_;
  const Levels& levels_;
  const FloatImage& still_;
  std::span<const Actor> bodies_;
  ShareLattice& still_shares_;
  const Care& care_;
  MarkCovers marks_;
  std::vector<std::vector<Bodies>> shading_bodies_;  // by body that is shaded, then lamp
  std::vector<std::vector<bool>> hall_is_clear_;     // between a body and a lamp
  // Of the tile at hand.
  Bodies seen_;
  // The lamps that a body keeps from what stands still, by block of kBlock_px.
  std::array<std::vector<std::size_t>, 4> shaded_lamps_;
  bool shaded_ = false;
  Bodies near_;  // a point, on its way to a lamp
  FaceShares face_shares_;
  std::vector<double> radiance_;  // of one patch, by lamp
};

}  // namespace dottrack::host_sim
