// The lens's blur: a Gaussian, along the rows and then along the columns.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "host_sim/renderer/sensor.h"
#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

constexpr double kReachInSigmas = 4.0;  // beyond lies less than 1e-4 of the light
constexpr int kMostReach_px = 16;

// Weights of one half: [k] of the samples k pixels away, on both sides.
struct Kernel {
  int reach_px = 0;
  std::array<float, kMostReach_px + 1> weights{};
};

Kernel gaussian(double sigma_px) {
  Kernel kernel;
  kernel.reach_px = blur_reach_px(sigma_px);
  std::array<double, kMostReach_px + 1> weights{};
  double sum = 0.0;
  for (int k = 0; k <= kernel.reach_px; ++k) {
    const double offset = k / sigma_px;
    const double weight = exponential(-0.5 * offset * offset);
    weights[static_cast<std::size_t>(k)] = weight;
    sum += k == 0 ? weight : 2.0 * weight;
  }
  for (std::size_t k = 0; k < weights.size(); ++k) {
    kernel.weights[k] = static_cast<float>(weights[k] / sum);
  }
  return kernel;
}

int within(int v, int size) {
  return std::clamp(v, 0, size - 1);
}

void weigh(const float* in, float weight, int count, float* out) {
  for (int i = 0; i < count; ++i) out[i] = weight * in[i];
}

void add_pair(const float* a, const float* b, float weight, int count, float* out) {
  for (int i = 0; i < count; ++i) out[i] += weight * (a[i] + b[i]);
}

// Row y of `light` from `x0 - reach` on, with the border repeated outside the image.
void take_row(const FloatImage& light, int y, int x0, std::vector<float>& row) {
  const int last = light.width_px() - 1;
  const int count = static_cast<int>(row.size());
  for (int i = 0; i < count; ++i) {
    const int x = x0 + i;
    row[static_cast<std::size_t>(i)] = light.at(std::clamp(x, 0, last), y);
  }
}

// The rows of the box and `reach` more above and below, blurred along x.
FloatImage blurred_rows(const FloatImage& light, const PixelBox& box, const Kernel& kernel) {
  const int reach = kernel.reach_px;
  const int width = box.x1 - box.x0;
  FloatImage rows(width, box.y1 - box.y0 + 2 * reach);
  std::vector<float> padded(static_cast<std::size_t>(width + 2 * reach));
  for (int row = 0; row < rows.height_px(); ++row) {
    take_row(light, within(box.y0 + row - reach, light.height_px()), box.x0 - reach, padded);
    const float* middle = padded.data() + reach;
    float* out = &rows.at(0, row);
    weigh(middle, kernel.weights[0], width, out);
    for (int k = 1; k <= reach; ++k) {
      add_pair(middle - k, middle + k, kernel.weights[static_cast<std::size_t>(k)], width, out);
    }
  }
  return rows;
}

}  // namespace

int blur_reach_px(double sigma_px) {
  if (!(sigma_px > 0.0)) return 0;
  return std::min(static_cast<int>(std::ceil(kReachInSigmas * sigma_px)), kMostReach_px);
}

void blur(const FloatImage& light, const PixelBox& box, double sigma_px, FloatImage& blurred) {
  if (box.empty()) return;
  const int width = box.x1 - box.x0;
  if (!(sigma_px > 0.0)) {
    for (int y = box.y0; y < box.y1; ++y) {
      std::copy_n(&light.at(box.x0, y), width, &blurred.at(box.x0, y));
    }
    return;
  }
  const Kernel kernel = gaussian(sigma_px);
  const FloatImage rows = blurred_rows(light, box, kernel);
  for (int y = box.y0; y < box.y1; ++y) {
    const int middle = y - box.y0 + kernel.reach_px;
    float* out = &blurred.at(box.x0, y);
    weigh(&rows.at(0, middle), kernel.weights[0], width, out);
    for (int k = 1; k <= kernel.reach_px; ++k) {
      add_pair(&rows.at(0, middle - k), &rows.at(0, middle + k),
               kernel.weights[static_cast<std::size_t>(k)], width, out);
    }
  }
}

}  // namespace dottrack::host_sim
