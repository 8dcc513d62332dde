#pragma once
// The candidates sorted into a flat grid, so that an anchor meets only those around it.

#include <array>
#include <cstdint>
#include <span>

#include "app/core/acquisition/edge_table.h"
#include "app/core/acquisition/select.h"

namespace dottrack::acquisition {

// A candidate whose distance from the anchor may be that of these dots.
struct Neighbour {
  std::uint16_t place = 0;
  DotSet dots = 0;
};

struct Neighbours {
  std::array<Neighbour, core::kMaxFinalists> list;
  std::size_t size = 0;
  DotSet dots = 0;         // of all of them
  std::size_t looked = 0;  // candidates whose distance was taken
};

// Candidates are known by their place in the grid's order: those of one cell follow each other, and
// those of a row of cells, too. Cells are columns without end, across the axis along which the
// candidates spread least.
class CandidateGrid {
 public:
  // Takes those candidates whose diameter is in the range, and cells for looking about as far as
  // `reach_m`. Work is proportional to the number of candidates.
  void build(std::span<const DotCandidate> candidates, double least_diameter_m,
             double most_diameter_m, double reach_m);

  std::size_t size() const { return size_; }
  std::uint16_t candidate(std::size_t place) const { return candidate_[place]; }
  // That the grid's distances may be off.
  double rounding_m() const { return rounding_m_; }

  // The others whose distance from the one at `place` is in the table.
  void neighbours(std::size_t place, const EdgeTable& table, Neighbours& found) const;

  // A block of cells, up to and including the last, and the grid's arrays: what the search for
  // neighbours runs over.
  struct Block {
    std::array<const float*, 3> coordinates_m{};
    const std::uint16_t* first = nullptr;  // by cell, row after row
    std::size_t columns = 0;
    std::size_t first_row = 0;
    std::size_t last_row = 0;
    std::size_t first_column = 0;
    std::size_t last_column = 0;
  };

 private:
  static constexpr std::size_t kMaxRows = 64;
  static constexpr std::size_t kMaxColumns = 128;
  static constexpr std::size_t kSpare = 16;  // reading in whole SIMD registers goes so far beyond

  using Coordinates = std::array<float, core::kMaxFinalists + kSpare>;

  struct Axis {
    std::size_t index = 0;  // 0 is x
    std::size_t cells = 1;
    float cells_per_m = 0.0F;

    Axis() = default;
    Axis(std::size_t axis, double extent_m, double cell_m, std::size_t most_cells);
    std::size_t cell(float coordinate_m) const;
  };

  std::array<float, 3> from_origin(const Eigen::Vector3d& position_m) const;
  void sort_in(std::span<const DotCandidate> candidates);

  std::size_t size_ = 0;
  double rounding_m_ = 0.0;
  Axis row_;
  Axis column_;
  Eigen::Vector3d origin_m_ = Eigen::Vector3d::Zero();
  std::array<Coordinates, 3> coordinates_m_{};  // from the origin
  std::array<std::uint16_t, core::kMaxFinalists> candidate_{};
  std::array<std::uint16_t, core::kMaxFinalists> taken_{};
  std::array<std::uint16_t, core::kMaxFinalists> cell_of_{};
  std::array<std::uint16_t, kMaxRows * kMaxColumns + 1> first_{};  // by cell, row after row
};

}  // namespace dottrack::acquisition
