#include "host_sim/renderer/sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

constexpr int kReach_px = 3;
using Kernel = std::array<float, 2 * kReach_px + 1>;  // weight i belongs to an offset i - kReach_px

Kernel gaussian(double sigma_px) {
  std::array<double, Kernel{}.size()> weights{};
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double offset = static_cast<double>(i) - kReach_px;
    weights[i] = exponential(-0.5 * offset * offset / (sigma_px * sigma_px));
    sum += weights[i];
  }
  Kernel kernel{};
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    kernel[i] = static_cast<float>(weights[i] / sum);
  }
  return kernel;
}

int within(int v, int size) {
  return std::clamp(v, 0, size - 1);
}

// One row of the image, blurred along x, for columns x0 to x1.
void blur_row(const FloatImage& light, int y, const PixelBox& box, const Kernel& kernel,
              FloatImage& rows, int row) {
  for (int x = box.x0; x < box.x1; ++x) {
    float sum = 0.0F;
    int column = x - kReach_px;
    for (const float weight : kernel) {
      sum += weight * light.at(within(column++, light.width_px()), y);
    }
    rows.at(x - box.x0, row) = sum;
  }
}

std::uint8_t rounded(double dn) {
  return static_cast<std::uint8_t>(std::clamp(std::floor(dn + 0.5), 0.0, 255.0));
}

}  // namespace

int blur_reach_px(double sigma_px) {
  return sigma_px > 0.0 ? kReach_px : 0;
}

void blur(const FloatImage& light, const PixelBox& box, double sigma_px, FloatImage& blurred) {
  if (box.empty()) return;
  if (!(sigma_px > 0.0)) {
    for (int y = box.y0; y < box.y1; ++y) {
      for (int x = box.x0; x < box.x1; ++x) blurred.at(x, y) = light.at(x, y);
    }
    return;
  }
  const Kernel kernel = gaussian(sigma_px);
  FloatImage rows(box.x1 - box.x0, box.y1 - box.y0 + 2 * kReach_px);
  for (int row = 0; row < rows.height_px(); ++row) {
    blur_row(light, within(box.y0 + row - kReach_px, light.height_px()), box, kernel, rows, row);
  }
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      float sum = 0.0F;
      int row = y - box.y0;
      for (const float weight : kernel) sum += weight * rows.at(x - box.x0, row++);
      blurred.at(x, y) = sum;
    }
  }
}

Sensor::Sensor(const SensorModel& model, int width_px, int height_px)
    : model_(model), gain_dn_(width_px, height_px) {
  const double half_x = 0.5 * (width_px - 1);
  const double half_y = 0.5 * (height_px - 1);
  const double corner2 = half_x * half_x + half_y * half_y;
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const double radius2 = (x - half_x) * (x - half_x) + (y - half_y) * (y - half_y);
      const double falloff = 1.0 - model.corner_falloff * (radius2 / corner2);
      gain_dn_.at(x, y) = static_cast<float>(255.0 * model.exposure * falloff);
    }
  }
}

void Sensor::expose(const FloatImage& light, const NoiseKey& noise, GreyImage& image) const {
  const std::uint64_t key = mix(mix(noise.seed, noise.camera), noise.tick);
  const double read2 = model_.read_noise_dn * model_.read_noise_dn;
  std::uint64_t pixel = 0;
  for (int y = 0; y < image.height_px(); ++y) {
    for (int x = 0; x < image.width_px(); ++x, pixel += 2) {
      double dn = static_cast<double>(gain_dn_.at(x, y)) * static_cast<double>(light.at(x, y));
      if (model_.noise) {
        const double sigma_dn = std::sqrt(read2 + dn / model_.electrons_per_dn);
        dn += sigma_dn * nearly_normal(mix(key + pixel), mix(key + pixel + 1));
      }
      image.at(x, y) = rounded(dn);
    }
  }
}

}  // namespace dottrack::host_sim
