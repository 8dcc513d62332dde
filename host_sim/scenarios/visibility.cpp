#include "host_sim/scenarios/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "host_sim/scenarios/dot_disc.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

constexpr int kHiddenOfRim = 2;  // of kRimPoints, so many may be hidden

// All of the rim in the picture, and far enough apart.
bool shows_large_enough(const SimCamera& camera, const Disc& disc) {
  std::array<Eigen::Vector2d, kRimPoints> pixels;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (!in_picture(camera, disc.rim[i])) return false;
    pixels[i] = *camera.project(disc.rim[i]);
  }
  double widest_px = 0.0;
  for (std::size_t i = 0; i < pixels.size() / 2; ++i) {
    widest_px = std::max(widest_px, (pixels[i] - pixels[i + pixels.size() / 2]).norm());
  }
  return widest_px >= kSmallestDot_px;
}

bool sees(const SimCamera& camera, const Disc& disc, const Obstacles& obstacles) {
  const Vector3d& eye = camera.centre_m();
  if ((eye - disc.middle).dot(disc.normal) <= 0.0) return false;
  if (!shows_large_enough(camera, disc) || obstacles.hidden(eye, disc.middle)) return false;
  const auto hidden = std::count_if(disc.rim.begin(), disc.rim.end(),
                                    [&](const Vector3d& p) { return obstacles.hidden(eye, p); });
  return hidden <= kHiddenOfRim;
}

}  // namespace

bool in_picture(const SimCamera& camera, const Vector3d& p_world, double margin_px) {
  const auto pixel = camera.project(p_world);
  return pixel && pixel->x() >= margin_px - 0.5 && pixel->y() >= margin_px - 0.5 &&
         pixel->x() <= camera.width_px() - 0.5 - margin_px &&
         pixel->y() <= camera.height_px() - 0.5 - margin_px;
}

int cameras_on(std::span<const SceneCamera> cameras, const Vector3d& p_world, double margin_px) {
  return static_cast<int>(std::count_if(
      cameras.begin(), cameras.end(),
      [&](const SceneCamera& camera) { return in_picture(camera.camera, p_world, margin_px); }));
}

Vector3d middle_of(const TargetLayout& target) {
  Vector3d sum = Vector3d::Zero();
  for (const TargetDot& dot : target) sum += dot.centre_m;
  return sum / static_cast<double>(std::max<std::size_t>(target.size(), 1));
}

std::vector<int> views_of_dots(std::span<const SceneCamera> cameras, const TargetLayout& target,
                               const Pose& vehicle, const Hall& hall,
                               std::span<const MovingBody> bodies, double time_s) {
  const Obstacles obstacles(hall, bodies, time_s);
  std::vector<int> views;
  for (const TargetDot& dot : target) {
    const Disc disc = disc_of(dot, vehicle);
    views.push_back(static_cast<int>(std::count_if(
        cameras.begin(), cameras.end(),
        [&](const SceneCamera& camera) { return sees(camera.camera, disc, obstacles); })));
  }
  return views;
}

int dots_in_two_views(std::span<const int> views) {
  return static_cast<int>(
      std::count_if(views.begin(), views.end(), [](int cameras) { return cameras >= 2; }));
}

}  // namespace dottrack::host_sim
