#pragma once
// When each row of a picture is exposed, and what the hall is like then.

#include <cstddef>
#include <span>
#include <vector>

#include "host_sim/renderer/actor.h"
#include "host_sim/renderer/camera_view.h"
#include "host_sim/renderer/sensor.h"
#include "host_sim/world/lamp.h"

namespace dottrack::host_sim {

// The middle of each row's exposure; of a global shutter, one for all.
std::vector<double> row_times(const Exposure& exposure, double line_time_s, int rows);

// Levels of the lamps, for all rows or row by row.
class Levels {
 public:
  Levels() = default;
  Levels(std::span<const Lamp> lamps, const LightPlan& plan, std::span<const double> times_s);

  double at(int row, std::size_t lamp) const {
    return by_row_[by_row_.size() == 1 ? 0 : static_cast<std::size_t>(row)][lamp];
  }
  // The same in all rows.
  bool steady() const { return by_row_.size() == 1; }
  bool operator==(const Levels&) const = default;

 private:
  std::vector<std::vector<double>> by_row_;
};

// The bodies that are in the hall, `offset_s` from the middle of the rows' exposures. A row for
// which a body has no pose shows it as the middle row.
std::vector<Actor> bodies_at(std::span<const MovingBody> bodies, std::span<const double> times_s,
                             double offset_s);

}  // namespace dottrack::host_sim
