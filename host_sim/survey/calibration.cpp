#include "host_sim/survey/calibration.h"

#include <fmt/format.h>

#include <algorithm>

#include "host_sim/renderer/normal_deviates.h"
#include "host_sim/survey/camera_fit.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kFewestDots = 15;  // that a surveyor would call a calibration
constexpr double kMargin_px = 5.0;       // a dot nearer to the border is not measured

// What the random numbers are for.
enum class Purpose : std::uint64_t { survey = 1, image, choice, places };

RandomStream stream(std::uint64_t seed, Purpose purpose, std::uint64_t of_what) {
  return {mix(seed, static_cast<std::uint64_t>(purpose)), of_what};
}

double normal(RandomStream& random) {
  return static_cast<double>(normal_deviates()[random.word() & 0xFFFFU]);
}

bool measurable(const SimCamera& camera, const Vector3d& dot) {
  const auto pixel = camera.project(dot);
  return pixel && pixel->x() > kMargin_px && pixel->x() < camera.width_px() - 1 - kMargin_px &&
         pixel->y() > kMargin_px && pixel->y() < camera.height_px() - 1 - kMargin_px;
}

// The dots that a camera is calibrated with, in the order of a draw.
std::vector<std::size_t> drawn(const SimCamera& camera, std::size_t index,
                               std::span<const Vector3d> dots, const CalibrationOptions& options) {
  std::vector<std::pair<std::uint64_t, std::size_t>> lots;
  RandomStream random = stream(options.seed, Purpose::choice, index);
  for (std::size_t i = 0; i < dots.size(); ++i) {
    const std::uint64_t lot = random.word();
    if (measurable(camera, dots[i])) lots.emplace_back(lot, i);
  }
  std::sort(lots.begin(), lots.end());
  if (lots.size() > options.dots_per_camera) lots.resize(options.dots_per_camera);
  std::vector<std::size_t> chosen;
  chosen.reserve(lots.size());
  for (const auto& [lot, dot] : lots) chosen.push_back(dot);
  return chosen;
}

Vector3d survey_error(std::size_t dot, const CalibrationOptions& options) {
  RandomStream random = stream(options.seed, Purpose::survey, dot);
  return options.survey_sigma_m * Vector3d{normal(random), normal(random), normal(random)};
}

// As an installer has it before any calibration: a tape measure, a data sheet, no distortion.
SimCamera rough_guess(const SimCamera& truth) {
  Lens lens = truth.lens();
  lens.focal_x_px *= 1.01;
  lens.focal_y_px *= 1.01;
  lens.centre_x_px += 4.0;
  lens.centre_y_px -= 3.0;
  lens.radial[1] = 0.0;
  lens.radial[2] = 0.0;
  const Vector3d eye = truth.centre_m() + Vector3d(0.04, -0.03, 0.05);
  return {eye, truth.rotation(), lens, truth.width_px(), truth.height_px()};
}

Result<SimCamera> calibrated_one(const SimCamera& truth, std::size_t index,
                                 std::span<const Vector3d> dots,
                                 const CalibrationOptions& options) {
  RandomStream random = stream(options.seed, Purpose::image, index);
  std::vector<Sighting> sightings;
  for (const std::size_t dot : drawn(truth, index, dots, options)) {
    const Vector2d noise = options.image_sigma_px * Vector2d{normal(random), normal(random)};
    sightings.push_back(
        {dots[dot] + survey_error(dot, options), *truth.project(dots[dot]) + noise});
  }
  if (sightings.size() < kFewestDots) {
    return fail(fmt::format("camera {} sees {} calibration dots, at least {} are needed", index + 1,
                            sightings.size(), kFewestDots));
  }
  const auto camera =
      fitted(rough_guess(truth), sightings, {options.survey_sigma_m, options.image_sigma_px});
  if (camera) return *camera;
  return fail(fmt::format("the {} calibration dots that camera {} sees do not determine it",
                          sightings.size(), index + 1));
}

}  // namespace

Result<std::vector<SimCamera>> calibrated(std::span<const SimCamera> truths,
                                          std::span<const Vector3d> dots,
                                          const CalibrationOptions& options) {
  std::vector<SimCamera> cameras;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    auto camera = calibrated_one(truths[i], i, dots, options);
    if (!camera) return tl::unexpected(camera.error());
    cameras.push_back(*camera);
  }
  return cameras;
}

std::vector<Vector3d> calibration_dots(double length_m, double width_m, double height_m,
                                       std::size_t count, std::uint64_t seed) {
  const double floor_m2 = length_m * width_m;
  const double long_walls_m2 = 2.0 * length_m * height_m;
  const double short_walls_m2 = 2.0 * width_m * height_m;
  std::vector<Vector3d> dots;
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream random = stream(seed, Purpose::places, i);
    const double at = random.uniform(0.0, floor_m2 + long_walls_m2 + short_walls_m2);
    const double side = random.uniform() < 0.5 ? -0.5 : 0.5;
    const double along = random.uniform(-0.5, 0.5);
    const double other = random.uniform();
    if (at < floor_m2) {
      dots.emplace_back(length_m * along, width_m * (other - 0.5), 0.0);
    } else if (at < floor_m2 + long_walls_m2) {
      dots.emplace_back(length_m * along, width_m * side, height_m * other);
    } else {
      dots.emplace_back(length_m * side, width_m * along, height_m * other);
    }
  }
  return dots;
}

}  // namespace dottrack::host_sim
