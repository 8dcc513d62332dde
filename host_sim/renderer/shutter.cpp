#include "host_sim/renderer/shutter.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace dottrack::host_sim {

std::vector<double> row_times(const Exposure& exposure, double line_time_s, int rows) {
  if (!(line_time_s > 0.0)) return {exposure.middle_s};
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row) {
    times.push_back(exposure.middle_s + (row - 0.5 * (rows - 1)) * line_time_s);
  }
  return times;
}

Levels::Levels(std::span<const Lamp> lamps, const LightPlan& plan,
               std::span<const double> times_s) {
  for (const double time_s : times_s) {
    std::vector<double>& levels = by_row_.emplace_back();
    for (const Lamp& lamp : lamps) levels.push_back(plan.level(lamp.group, time_s));
  }
  const bool steady = std::all_of(by_row_.begin(), by_row_.end(),
                                  [&](const auto& levels) { return levels == by_row_.front(); });
  if (steady) by_row_.resize(1);
}

std::vector<Actor> bodies_at(std::span<const MovingBody> bodies, std::span<const double> times_s,
                             double offset_s) {
  std::vector<Actor> actors;
  for (const MovingBody& body : bodies) {
    const auto middle = (*body.motion)(times_s[times_s.size() / 2] + offset_s);
    if (!middle || !(body.scene->radius_m() > 0.0)) continue;
    std::vector<Pose> poses;
    for (const double time_s : times_s) {
      poses.push_back((*body.motion)(time_s + offset_s).value_or(*middle));
    }
    actors.push_back(
        make_actor(static_cast<int>(actors.size()) + kFirstBody, *body.scene, std::move(poses)));
  }
  return actors;
}

}  // namespace dottrack::host_sim
