#pragma once
// The coarse first look of matching: which sightings of two cameras may be the same dot.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/core/acquisition/pencil.h"
#include "app/core/acquisition/sorted_rays.h"

namespace dottrack::acquisition {

// Goes through one camera's rays. For each it looks, among the other's rays near its plane of the
// pencil, for those that it asks for and that ask for it (see pencil.h): a few comparisons a pair,
// many pairs at a time. No pair that test_pair accepts is left out.
class PairFilter {
 public:
  // What one ray of a came to.
  struct Row {
    std::uint16_t first_hit = 0;
    std::uint16_t hits = 0;
    std::uint16_t looked_at = 0;  // rays of b
  };

  // Where rows are written, and after how many looks to stop.
  struct Room {
    std::span<Row> rows;
    std::span<std::uint16_t> hits;
    std::size_t looks = 0;
  };

  // False when the cameras form no pairs. The arrays must stay as they are until the next start.
  bool start(const RayArrays& a, const RayArrays& b, double max_miss_m);

  // The next rows from a's ray `from` on: a part of them, at least one if any is left.
  std::span<const Row> rows(std::size_t from);

  // The rays of b that may belong to the row's ray, ascending. Until rows() is called again.
  std::span<const std::uint16_t> hits(const Row& row) const {
    return {hits_.data() + row.first_hit, row.hits};
  }

 private:
  void add_strays(std::size_t i, Row& row);
  bool may_meet(std::size_t i, std::size_t j) const;

  static constexpr std::size_t kRoomForHits = 4096;
  static constexpr std::size_t kLooksInOneGo = 1U << 15U;
  static_assert(kRoomForHits >= 2 * core::kMaxRegions);

  const RayArrays* rays_a_ = nullptr;
  const RayArrays* rays_b_ = nullptr;
  float reach_m_ = 0.0F;
  PencilRays a_;
  PencilRays b_;
  SortedRays sorted_b_;
  std::array<Row, core::kMaxRegions> rows_{};
  std::array<std::uint16_t, kRoomForHits> hits_{};
};

}  // namespace dottrack::acquisition
