#pragma once
// What light control is told before it starts.

#include <array>

#include "hal/base/camera_set.h"
#include "hal/base/time.h"

namespace dottrack::exposure {

// What a camera does with the light that its lens lets in.
struct ExposureSetting {
  Duration exposure{};
  double gain = 1.0;  // factor on the signal, 1 = unity

  bool operator==(const ExposureSetting&) const = default;
};

struct LightSettings {
  bool on = false;           // off: the lenses and cameras are left as they are
  double target_dn = 191.0;  // the brightest dot of a camera: three quarters of full scale
  Duration exposure_min = std::chrono::microseconds(50);
  Duration exposure_max = std::chrono::milliseconds(10);
  double gain_min = 1.0;
  double gain_max = 8.0;
  int delay_ticks = 4;       // until a setting shows in a frame, at most
  double max_blur_px = 0.5;  // that a dot may move while it is exposed
  // As the cameras start.
  std::array<ExposureSetting, kMaxCameras> start{};
};

}  // namespace dottrack::exposure
