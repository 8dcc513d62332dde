#pragma once
// From light to grey levels: the lens's blur and fall-off, exposure, noise, rounding.

#include <cstdint>

#include "host_sim/renderer/image_buffer.h"

namespace dottrack::host_sim {

struct SensorModel {
  double blur_sigma_px = 0.6;      // 0: none
  double exposure = 1.0;           // radiance 1 becomes 255 DN times this
  double corner_falloff = 0.35;    // share of the light that is lost in the image's corners
  double read_noise_dn = 1.0;      // standard deviation
  double electrons_per_dn = 40.0;  // shot noise: variance = signal / electrons_per_dn
  bool noise = true;
};

// Gaussian blur of the part `box` of `light`; samples outside the image repeat its border.
void blur(const FloatImage& light, const PixelBox& box, double sigma_px, FloatImage& blurred);

// How many pixels away the blur still reaches.
int blur_reach_px(double sigma_px);

// Which noise: a pure function of these three and the pixel.
struct NoiseKey {
  std::uint64_t seed = 0;
  std::uint64_t camera = 0;
  std::uint64_t tick = 0;
};

class Sensor {
 public:
  Sensor(const SensorModel& model, int width_px, int height_px);

  const SensorModel& model() const { return model_; }
  // `light`: blurred radiance.
  void expose(const FloatImage& light, const NoiseKey& noise, GreyImage& image) const;

 private:
  SensorModel model_;
  FloatImage gain_dn_;  // DN for radiance 1, each pixel
};

}  // namespace dottrack::host_sim
