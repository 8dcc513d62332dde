#pragma once
// Lights with every field random, within what the bus can carry.

#include <cstdint>
#include <random>

#include "app/core/exposure/camera_light.h"

namespace dottrack::protocol::test {

inline exposure::CameraLight random_light(std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  exposure::CameraLight light;
  light.state = static_cast<exposure::LightState>(random() % 7);
  light.iris = static_cast<exposure::IrisCondition>(random() % 4);
  light.setting.exposure = Duration(static_cast<std::int64_t>(random() % 1'048'574'001U));
  light.setting.gain = 40.94 * share(random);
  light.opening = share(random);
  return light;
}

}  // namespace dottrack::protocol::test
