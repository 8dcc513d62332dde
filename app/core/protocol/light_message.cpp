#include "app/core/protocol/light_message.h"

#include "app/core/protocol/dbc_layout.h"
#include "app/core/protocol/frame_writer.h"
#include "app/core/protocol/rounding.h"

namespace dottrack::protocol {
namespace {

namespace s = layout::light;

// Written so that NaN does not fit.
std::uint64_t raw_within(const layout::Signal& signal, double value, double most) {
  return value >= 0.0 && value <= most ? raw_nearest(signal, value) : signal.not_available();
}

double most_of(const layout::Signal& signal) {
  return static_cast<double>(signal.largest()) * signal.factor;
}

std::uint64_t settings_word(const exposure::CameraLight& light) {
  if (light.state == exposure::LightState::off) {
    return put(s::kExposure, s::kExposure.not_available()) |
           put(s::kGain, s::kGain.not_available()) | put(s::kOpening, s::kOpening.not_available());
  }
  const double exposure_s = to_seconds(light.setting.exposure);
  return put(s::kExposure, raw_within(s::kExposure, exposure_s, most_of(s::kExposure))) |
         put(s::kGain, raw_within(s::kGain, light.setting.gain, most_of(s::kGain))) |
         put(s::kOpening, raw_within(s::kOpening, light.opening, 1.0));
}

}  // namespace

hal::CanFrame encode_light(std::uint8_t camera, const exposure::CameraLight& light,
                           const Addressing& addressing, std::uint8_t sequence) {
  const std::uint64_t word =
      put(s::kCamera, camera) | put(s::kLightState, static_cast<std::uint64_t>(light.state)) |
      put(s::kIris, static_cast<std::uint64_t>(light.iris)) | settings_word(light);
  hal::CanFrame frame;
  FrameWriter(addressing, sequence).write(s::kMessage, word, frame);
  return frame;
}

}  // namespace dottrack::protocol
