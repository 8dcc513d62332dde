#include "app/config/light.h"

#include <cmath>

namespace dottrack::config {
namespace {

constexpr double kFullScale_dn = 255.0;

Duration milliseconds(double ms) {
  return Duration(std::llround(1e6 * ms));
}

}  // namespace

exposure::LightSettings light_settings(const RigConfig& config) {
  const LightConfig& light = config.unit.light;
  exposure::LightSettings settings{.on = light.control,
                                   .target_dn = light.target_part * kFullScale_dn,
                                   .exposure_min = milliseconds(light.exposure_ms[0]),
                                   .exposure_max = milliseconds(light.exposure_ms[1]),
                                   .gain_min = light.gain[0],
                                   .gain_max = light.gain[1],
                                   .delay_ticks = light.delay_ticks,
                                   .max_blur_px = light.max_blur_px};
  for (std::size_t i = 0; i < config.cameras.size(); ++i) {
    const CameraUnitConfig& camera = config.unit.cameras[i];
    settings.start[i] = {milliseconds(camera.exposure_ms), camera.gain};
  }
  return settings;
}

}  // namespace dottrack::config
