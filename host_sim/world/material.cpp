#include "host_sim/world/material.h"

#include <algorithm>
#include <cmath>

#include "host_sim/world/noise.h"

namespace dottrack::host_sim {
namespace {

// How much of a window of the given width around x lies on lines of `line_m`, every `period_m`.
double line_share(double x, double period_m, double line_m, double window_m) {
  const double phase = x - period_m * std::floor(x / period_m + 0.5);  // distance to a line
  const double low = std::max(phase - 0.5 * window_m, -0.5 * line_m);
  const double high = std::min(phase + 0.5 * window_m, 0.5 * line_m);
  return std::clamp((high - low) / window_m, 0.0, 1.0);
}

double mottled(const Material& m, const Eigen::Vector3d& p) {
  const double coarse = value_noise(Eigen::Vector3d(p / 0.11), m.seed);
  const double fine = value_noise(Eigen::Vector3d(p / 0.025), m.seed + 1);
  return m.albedo * (1.0 + 0.20 * coarse + 0.18 * fine);
}

double cells(const Material& m, const Eigen::Vector3d& p, double window_m) {
  const double along = line_share(p.x(), 0.080, 0.006, window_m);
  const double across = line_share(p.y(), 0.045, 0.004, window_m);
  const double seams = along + across - along * across;
  const double tone = value_noise(
      Eigen::Vector3d(std::floor(p.x() / 0.080 + 0.5), std::floor(p.y() / 0.045 + 0.5), 0.0),
      m.seed);
  return m.albedo * (1.0 + 0.12 * tone) + 0.13 * seams;
}

double planks(const Material& m, const Eigen::Vector3d& p, double window_m) {
  const double gaps = line_share(p.z() + 0.07, 0.14, 0.008, window_m);
  const double grain = value_noise(
      Eigen::Vector3d(p.x() * 2.0, p.y() * 2.0, std::floor(p.z() / 0.14) + 40.0 * p.z()), m.seed);
  return m.albedo * (1.0 + 0.10 * grain) * (1.0 - 0.6 * gaps);
}

double stripes(const Material& m, const Eigen::Vector3d& p, double window_m) {
  const double bright = line_share(p.x() + p.y() + p.z(), 0.24, 0.12, window_m);
  return m.albedo * (0.15 + 0.85 * bright);
}

}  // namespace

double albedo_at(const Material& material, const Eigen::Vector3d& p_body, double footprint_m) {
  const double window_m = std::max(footprint_m, 1e-4);
  switch (material.pattern) {
    case Pattern::plain:
      return material.albedo;
    case Pattern::mottled:
      return mottled(material, p_body);
    case Pattern::cells:
      return cells(material, p_body, window_m);
    case Pattern::planks:
      return planks(material, p_body, window_m);
    case Pattern::stripes:
      return stripes(material, p_body, window_m);
  }
  return material.albedo;
}

}  // namespace dottrack::host_sim
