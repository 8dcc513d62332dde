#include "app/workstation/calibrate/fit/setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/config/camera_internal.h"
#include "app/workstation/calibrate/fit/camera_priors.h"
#include "app/workstation/calibrate/fit/camera_start.h"
#include "app/workstation/calibrate/fit/chi_square.h"
#include "app/workstation/calibrate/fit/information.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kFewestDots = 6;
constexpr double kLeastSigma_m = 1e-9;
constexpr double kHeldScaleSigma = 1e-4;
constexpr double kLeastNoise_px = 0.02;  // of what is called a dot
constexpr double kMostNoise_px = 0.5;
constexpr double kPoorScale = 0.2;  // a focal length that is known no better is not known

double median_distance_m(std::span<const Vector3d> points, const Vector3d& from) {
  std::vector<double> distances;
  for (const Vector3d& p : points) distances.push_back((p - from).norm());
  const auto middle = distances.begin() + static_cast<long>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

bool sees_all(const geometry::CameraModel& model, std::span<const Vector3d> points) {
  return std::all_of(points.begin(), points.end(), [&](const Vector3d& p) {
    const geometry::Cahv m = config::linear_part(model);
    return (p - m.c).dot(m.a) > 0.0;
  });
}

double median_off_px(const geometry::CameraModel& model, std::span<const Vector3d> points,
                     std::span<const Vector2d> pixels) {
  std::vector<double> off_px;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vector2d at(1e6, 1e6);
    static_cast<void>(project(model, points[i], at));
    off_px.push_back((at - pixels[i]).norm());
  }
  const auto middle = off_px.begin() + static_cast<long>(off_px.size() / 2);
  std::nth_element(off_px.begin(), middle, off_px.end());
  return *middle;
}

// Standard deviation of the focal length, a part of it, where a plane's own perspective is all that
// tells it: as noisy as the residuals are, of which a lens may have made the most.
double focal_sigma(const StartedCamera& camera, std::span<const Vector3d> points,
                   std::span<const Vector2d> pixels) {
  Adjustment plane;
  plane.cameras.push_back(prepared(camera, {}, 0));
  const double off_px = median_off_px(camera.start, points, pixels);
  const double sigma_px = std::clamp(off_px / std::sqrt(kMedian2), kLeastNoise_px, kMostNoise_px);
  for (std::size_t i = 0; i < points.size(); ++i) {
    AdjustedDot dot;
    dot.surveyed_m = points[i];
    dot.sigma_m.setConstant(1e-6 * camera.distance_m);
    plane.dots.push_back(dot);
    plane.views.push_back({0, i, pixels[i], sigma_px, true});
  }
  const auto information = inform(plane);
  if (!information) return std::numeric_limits<double>::infinity();
  return std::sqrt(information->cameras[0](kScale, kScale));
}

bool scale_is_told(StartedCamera camera, const geometry::Cahv& start,
                   std::span<const Vector3d> points, std::span<const Vector2d> pixels) {
  camera.start = start;
  camera.distance_m = median_distance_m(points, start.c);
  return !camera.flat || focal_sigma(camera, points, pixels) < kPoorScale;
}

}  // namespace

Result<StartedCamera> started(std::span<const SurveyedDot> dots, const CameraViews& views) {
  if (views.observations.size() < kFewestDots) {
    return fail(
        fmt::format("camera {}: {} dots are seen and labelled, at least {} are needed; {} "
                    "or more, spread over the image and in depth, are better",
                    views.name, views.observations.size(), kFewestDots, 20));
  }
  std::vector<Vector3d> points;
  std::vector<Vector2d> pixels;
  for (const Observation& seen : views.observations) {
    points.push_back(dots[seen.dot].position_m);
    pixels.push_back(seen.pixel);
  }
  StartedCamera camera;
  camera.extent = {views.width_px, views.height_px};
  camera.flat = in_a_plane(points);
  const auto start = start_from({points, pixels}, camera.extent);
  if (start && scale_is_told(camera, *start, points, pixels)) {
    camera.start = *start;
  } else if (views.approximate && sees_all(*views.approximate, points)) {
    camera.start = *views.approximate;
    camera.hold_scale = true;
  } else if (camera.flat) {
    return fail(
        fmt::format("camera {}: its {} dots are in one plane that it looks at nearly straight on: "
                    "distance and focal length cannot be told apart; add dots off that "
                    "plane, tilt it, or give an approximate model",
                    views.name, points.size()));
  } else {
    return fail(
        fmt::format("camera {}: its {} dots do not determine a camera: they are on a line, "
                    "or their labels are wrong",
                    views.name, points.size()));
  }
  camera.distance_m = median_distance_m(points, geometry::centre(camera.start));
  return camera;
}

Result<void> check_handedness(std::span<const CameraViews> views,
                              std::span<const StartedCamera> cameras) {
  std::string names;
  std::size_t count = 0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (!mirrored(config::linear_part(cameras[i].start))) continue;
    names += (count++ == 0 ? "" : ", ") + views[i].name;
  }
  if (count == 0) return {};
  if (count == cameras.size()) {
    return fail(
        "every camera sees the dots mirrored: their coordinates are left-handed; exchange two of "
        "the axes or change the sign of one");
  }
  return fail(
      fmt::format("camera {}: sees the dots mirrored, the other cameras do not: its images "
                  "are mirrored, or its dots wrongly labelled",
                  names));
}

AdjustedCamera prepared(const StartedCamera& camera, const LensKind& kind, std::uint64_t seed) {
  AdjustedCamera out;
  out.camera = numbered(camera.start, camera.extent, camera.distance_m, kind);
  out.priors = priors_of(kind, out.camera.frame, camera.extent, camera.flat);
  if (camera.hold_scale) out.priors.sigma[kScale] = kHeldScaleSigma;
  // What tan is to an angle, where the start is a pinhole.
  if (kind.form == LensForm::pupil && kind.linearity == 0.0 &&
      std::holds_alternative<geometry::Cahv>(camera.start)) {
    out.camera.numbers[kRadial] = 1.0 / 3.0;
    out.camera.numbers[kRadial + 1] = 2.0 / 15.0;
  }
  if (seed != 0) throw_off(out.camera, seed);
  return out;
}

std::vector<AdjustedDot> surveyed(std::span<const SurveyedDot> dots, double default_sigma_m) {
  std::vector<AdjustedDot> out;
  for (const SurveyedDot& dot : dots) {
    AdjustedDot& adjusted = out.emplace_back();
    adjusted.surveyed_m = dot.position_m;
    for (int i = 0; i < 3; ++i) {
      const double sigma = dot.sigma_m[i] > 0.0 ? dot.sigma_m[i] : default_sigma_m;
      adjusted.sigma_m[i] = std::max(sigma, kLeastSigma_m);
    }
  }
  return out;
}

std::vector<View> views_of(const CameraViews& views, std::size_t camera) {
  std::vector<View> out;
  for (const Observation& seen : views.observations) {
    out.push_back({camera, seen.dot, seen.pixel, seen.sigma_px > 0.0 ? seen.sigma_px : 0.1, true});
  }
  return out;
}

}  // namespace dottrack::calibrate
