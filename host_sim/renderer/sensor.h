#pragma once
// From light to grey levels: the lens's blur and fall-off, exposure, gain and iris, shot and read
// noise, saturation with blooming, rounding to 8 bits.

#include <cstdint>
#include <vector>

#include "host_sim/renderer/image_buffer.h"

namespace dottrack::host_sim {

inline constexpr double kReferenceExposure_s = 0.004;

struct SensorModel {
  double blur_sigma_px = 0.6;    // 0: none
  double sensitivity = 1.0;      // radiance 1 gives 255 DN times this at the reference exposure,
                                 // unit gain and a fully open iris
  double corner_falloff = 0.35;  // share of the light that is lost in the image's corners
  double black_level_dn = 0.0;
  double read_noise_dn = 1.0;      // standard deviation at unit gain
  double electrons_per_dn = 40.0;  // at unit gain; shot noise: variance = electrons
  // What a pixel cannot hold above full_well_dn spills along its column, most of it downwards
  // (the direction of read-out), until other pixels have taken it up. 0: it is lost.
  double bloom_share = 0.0;
  double full_well_dn = 280.0;  // at unit gain
  double line_time_s = 0.0;     // rolling shutter: from one row to the next; 0: global shutter
  bool noise = true;
};

// Which noise: a pure function of these three and the pixel.
struct NoiseKey {
  std::uint64_t seed = 0;
  std::uint64_t camera = 0;
  std::uint64_t tick = 0;
};

// What the camera and its lens were set to in one exposure.
struct Exposure {
  double middle_s = 0.0;  // of the middle row
  double duration_s = kReferenceExposure_s;
  double gain = 1.0;
  double opening = 1.0;  // share of the light of a fully open iris
  NoiseKey noise{};
};

// Gaussian blur of the part `box` of `light`; samples outside the image repeat its border.
void blur(const FloatImage& light, const PixelBox& box, double sigma_px, FloatImage& blurred);

// How many pixels away the blur still reaches: four sigmas, 16 pixels at most.
int blur_reach_px(double sigma_px);

class Sensor {
 public:
  Sensor(const SensorModel& model, int width_px, int height_px);

  const SensorModel& model() const { return model_; }
  // What the pixels hold when the shutter closes, above black at unit gain, bloomed, without noise.
  // `light`: blurred radiance. One thread at a time.
  void collect(const FloatImage& light, const Exposure& exposure, FloatImage& charge_dn);
  // That read out, with the exposure's gain and noise.
  void read(const FloatImage& charge_dn, const Exposure& exposure, GreyImage& image) const;
  // Both, one after the other.
  void expose(const FloatImage& light, const Exposure& exposure, GreyImage& image) {
    collect(light, exposure, charge_dn_);
    read(charge_dn_, exposure, image);
  }

 private:
  void bloom(FloatImage& charge_dn);

  SensorModel model_;
  FloatImage falloff_;           // 1 in the middle of the picture
  std::vector<float> spilt_dn_;  // on its way along each column
  FloatImage upwards_dn_;        // what each pixel spills upwards
  FloatImage charge_dn_;
};

}  // namespace dottrack::host_sim
