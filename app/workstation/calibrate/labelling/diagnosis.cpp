#include "app/workstation/calibrate/labelling/diagnosis.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "app/config/complaint.h"
#include "app/workstation/calibrate/labelling/from_scratch.h"
#include "app/workstation/calibrate/labelling/guided.h"

namespace dottrack::calibrate {
namespace {

constexpr double kFurthest_m = 100.0;
constexpr double kNearest_m = 0.02;
constexpr double kDistanceFactor = 3.0;  // of what was believed; of a dot's size
constexpr double kSureGain = 15.0;       // of log odds
constexpr double kPointing_rad = 0.7;    // off what was believed

using Survey = std::vector<SurveyedDot>;

bool guessed(const CameraInput& input) {
  return input.approximate || input.near_m;
}

std::string named(const CameraInput& input) {
  return fmt::format("camera {}", config::in_quotes(input.pictures.name));
}

// The scene with another survey, or that of another camera with this one's.
Scene with_dots(const Scene& scene, std::span<const SurveyedDot> dots) {
  Scene other = scene;
  other.dots = dots;
  return other;
}

std::vector<Growth> guided(const Scene& scene, const CameraInput& input) {
  const SurveyIndex survey(scene.dots, scene.dot_layer);
  const SketchPrior prior = prior_of(input, scene.width_px, scene.height_px);
  auto labels = labels_from_guess(scene, survey, prior);
  if (!labels.empty() && !convincing(scene, labels.front())) labels.clear();
  return labels;
}

std::vector<Growth> unguided(const Scene& scene) {
  const SurveyIndex survey(scene.dots, scene.dot_layer);
  return labels_from_scratch(scene, survey, any_camera(scene.width_px, scene.height_px));
}

Survey scaled(std::span<const SurveyedDot> dots, double factor) {
  Survey survey(dots.begin(), dots.end());
  for (SurveyedDot& dot : survey) {
    dot.position_m *= factor;
    dot.diameter_m = 0.0;  // may be in another unit again
  }
  return survey;
}

Survey mirrored(std::span<const SurveyedDot> dots, int axis) {
  Survey survey(dots.begin(), dots.end());
  for (SurveyedDot& dot : survey) {
    dot.position_m[axis] = -dot.position_m[axis];
    if (dot.normal) (*dot.normal)[axis] = -(*dot.normal)[axis];
  }
  return survey;
}

std::optional<std::string> exchanged(const std::vector<CameraInput>& inputs,
                                     const std::vector<LabelledCamera>& cameras, std::size_t c) {
  for (std::size_t other = 0; other < inputs.size(); ++other) {
    if (other == c || !guessed(inputs[other])) continue;
    if (guided(cameras[c].scene, inputs[other]).empty()) continue;
    return fmt::format(
        "{}: its pictures do not fit its approximate {}, but that of {}; the two seem exchanged: "
        "swap their pictures or their {}",
        named(inputs[c]), inputs[c].approximate ? "model" : "place", named(inputs[other]),
        inputs[c].approximate ? "models" : "places");
  }
  return std::nullopt;
}

std::optional<std::string> wrong_unit(std::span<const SurveyedDot> dots, const CameraInput& input,
                                      const Scene& scene) {
  for (const double factor : {1e-3, 1e3, 1e-2, 1e2, 0.1, 10.0, 0.0254, 0.3048, 3.28084, 39.3701}) {
    const Survey survey = scaled(dots, factor);
    if (guided(with_dots(scene, survey), input).empty()) continue;
    return fmt::format(
        "{}: its pictures fit its approximate {} only if the survey is multiplied by {:g}; the "
        "survey is in another unit than its headings say",
        named(input), input.approximate ? "model" : "place", factor);
  }
  return std::nullopt;
}

constexpr int kSomeAxis = 3;

std::string mirror_line(const CameraInput& input, int axis) {
  constexpr std::array kHow{"change the sign of x", "change the sign of y", "change the sign of z",
                            "swap two axes or change the sign of one"};
  return fmt::format(
      "{}: its dots fit the survey only in a mirror; the coordinates are left-handed: {} in the "
      "survey",
      named(input), kHow[static_cast<std::size_t>(axis)]);
}

std::optional<std::string> wrong_hand(std::span<const SurveyedDot> dots, const CameraInput& input,
                                      const Scene& scene) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!guessed(input) && axis > 0) break;
    const Survey survey = mirrored(dots, axis);
    const Scene other = with_dots(scene, survey);
    if ((guessed(input) ? guided(other, input) : unguided(other)).empty()) continue;
    return mirror_line(input, guessed(input) ? axis : kSomeAxis);
  }
  return std::nullopt;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Measured {
  double distance_m = 0.0;   // median, to the dots
  double size = 1.0;         // of the blobs, over what diameters and distance say; 1: not known
  Eigen::Vector3d middle_m;  // of the dots
};

Measured measured(const LabelledCamera& camera) {
  const Growth& growth = camera.labellings.front();
  std::vector<double> distances;
  std::vector<double> sizes;
  Measured m;
  m.middle_m.setZero();
  for (std::size_t i = 0; i < growth.labels.size(); ++i) {
    if (growth.labels[i] == kNoBlob) continue;
    const SurveyedDot& dot = camera.scene.dots[i];
    const Blob& blob = camera.scene.blobs[static_cast<std::size_t>(growth.labels[i])];
    const double distance = (dot.position_m - growth.sketch.place_m()).norm();
    m.middle_m += dot.position_m;
    distances.push_back(distance);
    if (dot.diameter_m <= 0.0) continue;
    sizes.push_back(2.0 * blob.semi_major_px * distance /
                    (growth.sketch.focal_px * dot.diameter_m));
  }
  m.middle_m /= static_cast<double>(std::max<std::size_t>(distances.size(), 1));
  m.distance_m = median(distances);
  if (!sizes.empty()) m.size = median(sizes);
  return m;
}

std::optional<std::string> wrong_scale(const CameraInput& input, const Measured& m) {
  if (m.distance_m > kFurthest_m || m.distance_m < kNearest_m) {
    return fmt::format(
        "{}: the dots would be {:.3g} m away; the survey's unit is probably not what its headings "
        "say (m, cm, mm)",
        named(input), m.distance_m);
  }
  if (m.size > kDistanceFactor || m.size < 1.0 / kDistanceFactor) {
    return fmt::format(
        "{}: its dots are {:.3g} times as large as their diameters say; check the units of "
        "coordinates and diameters in the survey",
        named(input), m.size);
  }
  return std::nullopt;
}

// How far a labelled camera is from a guess, in units of what may be: above 1 is too far.
double misfit(const CameraInput& guess, const Growth& growth, const Measured& m) {
  const Sketch believed =
      guess.approximate ? as_sketch(*guess.approximate) : prior_of(guess, 1, 1).about;
  const Eigen::Vector3d place = believed.place_m();
  const double off_m = (place - growth.sketch.place_m()).norm();
  double far = off_m / (0.35 * m.distance_m + 0.5 * std::min(1.0, m.distance_m));
  if (guess.approximate) {
    const Eigen::AngleAxisd turned(
        Eigen::Matrix3d(growth.sketch.rotation * believed.rotation.transpose()));
    far = std::max(far, turned.angle() / kPointing_rad);
  }
  return far;
}

std::string misplaced(std::span<const SurveyedDot> dots, const std::vector<CameraInput>& inputs,
                      const std::vector<LabelledCamera>& cameras, std::size_t c,
                      const Measured& m) {
  const CameraInput& input = inputs[c];
  const Growth& growth = cameras[c].labellings.front();
  if (auto line = exchanged(inputs, cameras, c)) return *line;
  const Eigen::Vector3d place =
      input.near_m ? *input.near_m : as_sketch(*input.approximate).place_m();
  const double ratio = (place - m.middle_m).norm() / m.distance_m;
  if (ratio > kDistanceFactor || ratio < 1.0 / kDistanceFactor) {
    return fmt::format(
        "{}: its approximate place is {:.3g} times as far from the dots as its pictures say; the "
        "survey is in another unit than its headings say, or the place is wrong",
        named(input), ratio);
  }
  if (auto line = wrong_hand(dots, input, cameras[c].scene)) return *line;
  return fmt::format(
      "{}: its pictures put it at ({:.2f}, {:.2f}, {:.2f}) m, {:.2f} m from its approximate place; "
      "check that place, how the camera points, and the survey",
      named(input), growth.sketch.place_m().x(), growth.sketch.place_m().y(),
      growth.sketch.place_m().z(), (growth.sketch.place_m() - place).norm());
}

}  // namespace

std::string why_unlabelled(std::span<const SurveyedDot> dots,
                           const std::vector<CameraInput>& inputs,
                           const std::vector<LabelledCamera>& cameras, std::size_t c) {
  const CameraInput& input = inputs[c];
  const Scene& scene = cameras[c].scene;
  if (scene.blobs.empty()) {
    return fmt::format(
        "{}: no dot found in its pictures; check that they show the dots, and see --polarity, "
        "--min-contrast and --dot-px",
        named(input));
  }
  if (scene.blobs.size() < kLeastToTell) {
    return fmt::format(
        "{}: too few dots, {} found; expected {} or more: show it more of them, or see "
        "--min-contrast and --dot-px",
        named(input), scene.blobs.size(), kLeastToTell);
  }
  if (!input.seeds.empty()) {
    return fmt::format(
        "{}: its seeds do not lead to further dots; check them, and see --min-contrast and "
        "--dot-px",
        named(input));
  }
  if (guessed(input)) {
    if (auto line = exchanged(inputs, cameras, c)) return *line;
    if (auto line = wrong_unit(dots, input, scene)) return *line;
  }
  if (auto line = wrong_hand(dots, input, scene)) return *line;
  return fmt::format("{}: its {} dots in the image fit the survey nowhere; {}", named(input),
                     scene.blobs.size(),
                     guessed(input) ? "check the survey and the approximate models, or give --seeds"
                                    : "check the survey, or give --models, --near or --seeds");
}

std::optional<std::string> why_unbelievable(std::span<const SurveyedDot> dots,
                                            const std::vector<CameraInput>& inputs,
                                            const std::vector<LabelledCamera>& cameras) {
  std::vector<Measured> all;
  for (const LabelledCamera& camera : cameras) all.push_back(measured(camera));
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    if (guessed(inputs[c]) && misfit(inputs[c], cameras[c].labellings.front(), all[c]) > 1.0) {
      return misplaced(dots, inputs, cameras, c, all[c]);
    }
    if (auto line = wrong_scale(inputs[c], all[c])) return line;
  }
  // Cameras so near each other that each one's guess would do for the other.
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    for (std::size_t d = c + 1; d < cameras.size(); ++d) {
      if (!guessed(inputs[c]) || !guessed(inputs[d])) continue;
      const Growth& at_c = cameras[c].labellings.front();
      const Growth& at_d = cameras[d].labellings.front();
      const double own = std::min(misfit(inputs[c], at_c, all[c]), misfit(inputs[d], at_d, all[d]));
      const double other =
          std::max(misfit(inputs[d], at_c, all[c]), misfit(inputs[c], at_d, all[d]));
      if (own < 0.1 || other > 0.3 * own) continue;
      return fmt::format(
          "{} and {}: each one's pictures fit the other's approximate {}; they seem exchanged: "
          "swap their pictures or their {}",
          named(inputs[c]), named(inputs[d]), inputs[c].approximate ? "model" : "place",
          inputs[c].approximate ? "models" : "places");
    }
  }
  return std::nullopt;
}

Result<std::optional<std::string>> try_mirror(std::span<const SurveyedDot> dots,
                                              const std::vector<CameraInput>& inputs,
                                              const std::vector<LabelledCamera>& cameras) {
  for (const CameraInput& input : inputs) {
    if (guessed(input) || !input.seeds.empty()) return std::nullopt;
  }
  const LabelledCamera& first = cameras.front();
  const Survey survey = mirrored(dots, 0);
  const auto in_mirror = unguided(with_dots(first.scene, survey));
  if (in_mirror.empty()) return std::nullopt;
  const Growth& here = first.labellings.front();
  const Growth& there = in_mirror.front();
  const double gain = there.log_odds - here.log_odds;
  const double slight = 0.05 * here.log_odds;
  if (gain > kSureGain && there.labelled > here.labelled + 2) {
    return fail(mirror_line(inputs.front(), kSomeAxis));
  }
  if (gain < -slight) return std::nullopt;
  return "the dots look the same in a mirror, so that they cannot tell whether the survey is "
         "right-handed: check that, or give --seeds or --models";
}

}  // namespace dottrack::calibrate
