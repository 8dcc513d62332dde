#include "host_sim/renderer/group_light.h"

#include <algorithm>

namespace dottrack::host_sim {
namespace {

void add_row(const float* in, float level, std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] += level * in[i];
}

// out += level * in
void add(const FloatImage& in, float level, FloatImage& out) {
  add_row(in.pixels().data(), level, in.pixels().size(), &out.at(0, 0));
}

}  // namespace

GroupLight::GroupLight(const Backdrop& backdrop, std::span<const Lamp> lamps,
                       std::span<const LampLight> lights, const SensorModel& sensor) {
  const FloatImage dark(backdrop.bounced.width_px(), backdrop.bounced.height_px());
  const auto group_of = [&](std::size_t lamp) -> Group& {
    const auto same = std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) {
      return lamps[group.lamp].group == lamps[lamp].group;
    });
    return same != groups_.end() ? *same : groups_.emplace_back(Group{lamp, dark, dark});
  };
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    Group& group = group_of(i);
    add(backdrop.direct[i], 1.0F, group.light);
    add(backdrop.bounced, static_cast<float>(lights[i].bounce), group.light);
  }
  for (const Glow& glow : backdrop.glow) {
    group_of(glow.lamp).light.at(glow.x, glow.y) += glow.radiance;
  }
  for (Group& group : groups_) {
    blur(group.light, {0, 0, dark.width_px(), dark.height_px()}, sensor.blur_sigma_px,
         group.blurred);
  }
}

// Row by row, so that a sum stays at hand while its parts pass by.
void GroupLight::add_up(const Levels& levels, FloatImage& light, FloatImage& blurred) const {
  const auto width = static_cast<std::size_t>(light.width_px());
  for (int y = 0; y < light.height_px(); ++y) {
    float* lit = &light.at(0, y);
    float* soft = &blurred.at(0, y);
    std::fill_n(lit, width, 0.0F);
    std::fill_n(soft, width, 0.0F);
    for (const Group& group : groups_) {
      const auto level = static_cast<float>(levels.at(0, group.lamp));
      if (!(level > 0.0F)) continue;
      add_row(&group.light.at(0, y), level, width, lit);
      add_row(&group.blurred.at(0, y), level, width, soft);
    }
  }
}

}  // namespace dottrack::host_sim
