#pragma once
// The still hall by what is switched together: pictures in one steady light after another then cost
// a sum of a few pictures instead of one of all lamps.

#include <cstddef>
#include <span>
#include <vector>

#include "host_sim/renderer/backdrop.h"
#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/lamp_light.h"
#include "host_sim/renderer/sensor.h"
#include "host_sim/renderer/shutter.h"
#include "host_sim/world/lamp.h"

namespace dottrack::host_sim {

class GroupLight {
 public:
  // `lamps` and `lights`: the backdrop's, in its order.
  GroupLight(const Backdrop& backdrop, std::span<const Lamp> lamps,
             std::span<const LampLight> lights, const SensorModel& sensor);

  // The hall at steady levels, and the same blurred. Both have the backdrop's size.
  void add_up(const Levels& levels, FloatImage& light, FloatImage& blurred) const;

 private:
  struct Group {
    std::size_t lamp;  // one of them: their levels are the same
    FloatImage light;  // at level 1
    FloatImage blurred;
  };

  std::vector<Group> groups_;
};

}  // namespace dottrack::host_sim
