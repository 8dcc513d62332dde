#include "app/workstation/calibrate/fit/camera_start.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kTrims = 5;
constexpr double kTrimAt = 4.0;        // medians
constexpr double kLeastTrim_px = 1.0;  // nothing closer than this is wrong
constexpr std::size_t kSample = 9;
constexpr int kSamples = 200;
constexpr double kPoor = 0.01;  // of the image's longer side: a median that asks for samples

std::vector<double> distances_px(const geometry::Cahv& model, const Labelled& labelled) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < labelled.points.size(); ++i) {
    Vector2d at;
    const bool seen = project(model, labelled.points[i], at) == geometry::OpticsStatus::ok;
    distances.push_back(seen ? (at - labelled.pixels[i]).norm()
                             : std::numeric_limits<double>::infinity());
  }
  return distances;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Chosen {
  std::vector<Vector3d> points;
  std::vector<Vector2d> pixels;
};

geometry::Cahv trimmed(geometry::Cahv model, const Labelled& labelled, ImageExtent extent) {
  std::size_t before = labelled.points.size() + 1;
  for (int i = 0; i < kTrims; ++i) {
    const std::vector<double> distances = distances_px(model, labelled);
    const double limit = std::max(kTrimAt * median(distances), kLeastTrim_px);
    Chosen chosen;
    for (std::size_t k = 0; k < distances.size(); ++k) {
      if (!(distances[k] <= limit)) continue;
      chosen.points.push_back(labelled.points[k]);
      chosen.pixels.push_back(labelled.pixels[k]);
    }
    if (chosen.points.size() == before) break;
    before = chosen.points.size();
    const auto next = fit_cahv(chosen.points, chosen.pixels, extent);
    if (!next) break;
    model = *next;
  }
  return model;
}

std::optional<geometry::Cahv> best_of_samples(const Labelled& labelled, ImageExtent extent) {
  std::mt19937_64 random(1);
  std::optional<geometry::Cahv> best;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSamples; ++i) {
    Chosen sample;
    for (std::size_t k = 0; k < kSample; ++k) {
      const std::size_t at = random() % labelled.points.size();
      sample.points.push_back(labelled.points[at]);
      sample.pixels.push_back(labelled.pixels[at]);
    }
    const auto model = fit_cahv(sample.points, sample.pixels, extent);
    if (!model) continue;
    const double middle = median(distances_px(*model, labelled));
    if (!(middle < least)) continue;
    least = middle;
    best = model;
  }
  return best;
}

}  // namespace

std::optional<geometry::Cahv> start_from(const Labelled& labelled, ImageExtent extent) {
  if (labelled.points.empty()) return std::nullopt;
  const double longer = std::max(extent.width_px, extent.height_px);
  const auto all = fit_cahv(labelled.points, labelled.pixels, extent);
  std::optional<geometry::Cahv> best;
  if (all) best = trimmed(*all, labelled, extent);
  const auto middle = [&](const geometry::Cahv& m) { return median(distances_px(m, labelled)); };
  if (best && middle(*best) < kPoor * longer) return best;
  if (labelled.points.size() <= kSample) return best;
  if (const auto sampled = best_of_samples(labelled, extent)) {
    const geometry::Cahv other = trimmed(*sampled, labelled, extent);
    if (!best || middle(other) < middle(*best)) best = other;
  }
  return best;
}

bool in_a_plane(std::span<const Vector3d> points) {
  constexpr double kFlat = 2e-3;
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : points) middle += p;
  middle /= static_cast<double>(std::max<std::size_t>(points.size(), 1));
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vector3d& p : points) scatter += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter, Eigen::EigenvaluesOnly);
  return !(solver.eigenvalues()[0] > kFlat * kFlat * solver.eigenvalues()[1]);
}

void throw_off(NumberedCamera& camera, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };
  for (int i = 0; i < 3; ++i) {
    camera.numbers[static_cast<std::size_t>(kTurn + i)] += 0.05 * uniform();
    camera.numbers[static_cast<std::size_t>(kPlace + i)] += 0.1 * uniform();
  }
  camera.numbers[kScale] += 0.1 * uniform();
  camera.numbers[kCentre] += 0.03 * uniform();
  camera.numbers[kCentre + 1] += 0.03 * uniform();
}

}  // namespace dottrack::calibrate
