#include "host_sim/renderer/sensor.h"

#include <algorithm>
#include <cmath>

#include "host_sim/renderer/normal_deviates.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

constexpr float kSpilledDown = 0.75F;  // of what spills; the rest goes up

FloatImage falloff_of(double corner_falloff, int width_px, int height_px) {
  FloatImage falloff(width_px, height_px);
  const double half_x = 0.5 * (width_px - 1);
  const double half_y = 0.5 * (height_px - 1);
  const double corner2 = half_x * half_x + half_y * half_y;
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const double radius2 = (x - half_x) * (x - half_x) + (y - half_y) * (y - half_y);
      const double lost = corner2 > 0.0 ? corner_falloff * (radius2 / corner2) : 0.0;
      falloff.at(x, y) = static_cast<float>(1.0 - lost);
    }
  }
  return falloff;
}

// One pixel to the next: what the charge takes up of what has spilt so far.
void take_up(float well, float& charge, float& spilt) {
  const float taken = std::min(spilt, std::max(0.0F, well - charge));
  charge += taken;
  spilt -= taken;
}

// Normal deviates of row y, four to a word.
void draw_noise(std::uint64_t key, int y, std::vector<float>& deviates) {
  const NormalDeviates& normal = normal_deviates();
  const std::size_t words = deviates.size() / 4;
  const std::uint64_t first = static_cast<std::uint64_t>(y) * words;
  float* out = deviates.data();
  for (std::size_t i = 0; i < words; ++i, out += 4) {
    const std::uint64_t word = mix(key + (first + i) * 0x9E3779B97F4A7C15ULL);
    out[0] = normal[word & 0xFFFFU];
    out[1] = normal[(word >> 16U) & 0xFFFFU];
    out[2] = normal[(word >> 32U) & 0xFFFFU];
    out[3] = normal[word >> 48U];
  }
}

void read_row(const SensorModel& model, double gain, int width, const float* charge,
              const float* deviate, std::uint8_t* grey) {
  const auto black = static_cast<float>(model.black_level_dn) + 0.5F;  // rounds what follows
  const auto g = static_cast<float>(gain);
  const auto read2 = static_cast<float>(model.read_noise_dn * model.read_noise_dn);
  const auto shot = static_cast<float>(1.0 / model.electrons_per_dn);
  for (int x = 0; x < width; ++x) {
    const float sigma = std::sqrt(read2 + shot * charge[x]);
    const float dn = black + g * (charge[x] + sigma * deviate[x]);
    grey[x] = static_cast<std::uint8_t>(static_cast<int>(std::min(std::max(dn, 0.0F), 255.0F)));
  }
}

}  // namespace

Sensor::Sensor(const SensorModel& model, int width_px, int height_px)
    : model_(model),
      falloff_(falloff_of(model.corner_falloff, width_px, height_px)),
      spilt_dn_(static_cast<std::size_t>(width_px)),
      upwards_dn_(width_px, height_px) {}

void Sensor::collect(const FloatImage& light, const Exposure& exposure, FloatImage& charge_dn) {
  const auto factor = static_cast<float>(255.0 * model_.sensitivity * exposure.opening *
                                         (exposure.duration_s / kReferenceExposure_s));
  const auto well = static_cast<float>(model_.full_well_dn);
  if (charge_dn.width_px() != light.width_px() || charge_dn.height_px() != light.height_px()) {
    charge_dn = FloatImage(light.width_px(), light.height_px());
  }
  int over = 0;
  for (int y = 0; y < charge_dn.height_px(); ++y) {
    const float* in = &light.at(0, y);
    const float* share = &falloff_.at(0, y);
    float* charge = &charge_dn.at(0, y);
    for (int x = 0; x < charge_dn.width_px(); ++x) {
      charge[x] = factor * share[x] * in[x];
      over |= charge[x] > well ? 1 : 0;
    }
  }
  if (over != 0) bloom(charge_dn);
}

// All columns at once, row by row: first down, where most goes, then up.
void Sensor::bloom(FloatImage& charge_dn) {
  const auto well = static_cast<float>(model_.full_well_dn);
  const auto share = static_cast<float>(model_.bloom_share);
  const int width = charge_dn.width_px();
  const int height = charge_dn.height_px();
  float* spilt = spilt_dn_.data();
  std::fill_n(spilt, width, 0.0F);
  for (int y = 0; y < height; ++y) {
    float* charge = &charge_dn.at(0, y);
    float* up = &upwards_dn_.at(0, y);
    for (int x = 0; x < width; ++x) {
      const float excess = share * std::max(0.0F, charge[x] - well);
      charge[x] = std::min(charge[x], well);
      take_up(well, charge[x], spilt[x]);
      spilt[x] += kSpilledDown * excess;
      up[x] = (1.0F - kSpilledDown) * excess;
    }
  }
  std::fill_n(spilt, width, 0.0F);
  for (int y = height - 1; y >= 0; --y) {
    float* charge = &charge_dn.at(0, y);
    const float* up = &upwards_dn_.at(0, y);
    for (int x = 0; x < width; ++x) {
      take_up(well, charge[x], spilt[x]);
      spilt[x] += up[x];
    }
  }
}

void Sensor::read(const FloatImage& charge_dn, const Exposure& exposure, GreyImage& image) const {
  const int width = charge_dn.width_px();
  const int height = charge_dn.height_px();
  if (image.width_px() != width || image.height_px() != height) image = GreyImage(width, height);
  const NoiseKey& noise = exposure.noise;
  const std::uint64_t key = mix(mix(noise.seed, noise.camera), noise.tick);
  std::vector<float> deviates(static_cast<std::size_t>(width) + 3);  // zero without noise
  for (int y = 0; y < height; ++y) {
    if (model_.noise) draw_noise(key, y, deviates);
    read_row(model_, exposure.gain, width, &charge_dn.at(0, y), deviates.data(), &image.at(0, y));
  }
}

}  // namespace dottrack::host_sim
