#include "host_sim/world/lamp.h"

#include <algorithm>

namespace dottrack::host_sim {

double LightPlan::level(std::string_view group, double time_s) const {
  double level = 1.0;
  for (const LightChange& change : changes) {
    if (!group.starts_with(change.group)) continue;
    const bool initial = change.at_s <= 0.0;
    if (!initial && change.at_s > time_s) break;
    const double into_s = time_s - change.at_s;
    const bool done = initial || into_s >= change.over_s;
    level = done ? change.to : level + (change.to - level) * into_s / change.over_s;
  }
  return level;
}

}  // namespace dottrack::host_sim
