#pragma once
// From runs to 4-connected components: union-find over the runs of neighbouring rows.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/image/run_scan.h"

namespace dottrack::image {

// A 4-connected set of runs, its runs in a linked list.
struct Component {
  std::uint32_t parent;  // itself: a component; another: merged into that one
  std::uint32_t head;    // its first run in the order of rows
  std::uint32_t tail;
  std::int32_t area_px;
  std::int16_t x_min;
  std::int16_t x_max;
  std::int16_t y_min;
  std::int16_t y_max;
};

class Components {
 public:
  static constexpr std::uint32_t kEnd = 0xFFFFFFFFU;

  void connect(const RunList& runs);

  // Components in the order of their first pixels; those with parent != index were merged.
  std::size_t size() const { return size_; }
  const Component& operator[](std::size_t i) const { return components_[i]; }
  bool is_root(std::size_t i) const { return components_[i].parent == i; }
  std::uint32_t next_run(std::uint32_t run) const { return next_run_[run]; }

 private:
  std::uint32_t find(std::uint32_t label);
  std::uint32_t unite(std::uint32_t a, std::uint32_t b);
  void append(std::uint32_t label, std::uint32_t run, const Run& ends);
  std::uint32_t start(std::uint32_t run, const Run& ends);

  std::array<Component, RunList::kCapacity> components_{};
  std::array<std::uint32_t, RunList::kCapacity> label_{};
  std::array<std::uint32_t, RunList::kCapacity> next_run_{};
  std::size_t size_ = 0;
};

}  // namespace dottrack::image
