#include "host_sim/renderer/camera_renderer.h"

#include "host_sim/renderer/pixel_sampler.h"

namespace dottrack::host_sim {
namespace {

// Nearer than this the vehicle is in front of whatever it touches.
constexpr double kSameDistance = 1.0 - 1e-9;

FloatImage sum(const FloatImage& a, const FloatImage& b) {
  FloatImage total(a.width_px(), a.height_px());
  for (int y = 0; y < a.height_px(); ++y) {
    for (int x = 0; x < a.width_px(); ++x) total.at(x, y) = a.at(x, y) + b.at(x, y);
  }
  return total;
}

PixelBox whole(const FloatImage& image) {
  return {0, 0, image.width_px(), image.height_px()};
}

}  // namespace

CameraRenderer::CameraRenderer(const World& world, const SimCamera& camera,
                               const SensorModel& sensor)
    : world_(world),
      camera_(camera),
      sensor_(sensor, camera.width_px(), camera.height_px()),
      rays_(camera),
      still_(world.objects, camera, rays_),
      backdrop_(paint_backdrop(world, camera, rays_, still_)),
      lamp_(key_lamp_disc(world.lighting)),
      plain_(sum(backdrop_.key, backdrop_.rest)),
      plain_blurred_(plain_.width_px(), plain_.height_px()) {
  blur(plain_, whole(plain_), sensor.blur_sigma_px, plain_blurred_);
}

void CameraRenderer::render(const Pose& vehicle_pose, const NoiseKey& noise, GreyImage& image) {
  light_ = plain_;
  blurred_ = plain_blurred_;
  if (world_.vehicle) {
    const VehicleView vehicle(*world_.vehicle, vehicle_pose, world_.lighting, lamp_, camera_,
                              rays_);
    draw_vehicle(vehicle, vehicle.reach());
  }
  if (image.width_px() != camera_.width_px() || image.height_px() != camera_.height_px()) {
    image = GreyImage(camera_.width_px(), camera_.height_px());
  }
  sensor_.expose(blurred_, noise, image);
}

void CameraRenderer::draw_vehicle(const VehicleView& vehicle, const PixelBox& box) {
  if (box.empty()) return;
  const auto cast = [&](int x, int y, const Eigen::Vector3d& direction) {
    const SurfaceHit hit = vehicle.cast(x, y, direction);
    const bool hidden =
        hit.surface != kNothing && still_.hides(x, y, direction, hit.distance * kSameDistance);
    return hidden ? SurfaceHit{} : hit;
  };
  const auto is_mark = [&](int surface) { return vehicle.is_mark(surface); };
  const PixelSampler sampler(rays_, box, cast, is_mark);
  Patches patches;
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      sampler.sample(x, y, patches);
      light_.at(x, y) = light_at(vehicle, x, y, patches);
    }
  }
  const double sigma_px = sensor_.model().blur_sigma_px;
  blur(light_, grown(box, blur_reach_px(sigma_px), light_.width_px(), light_.height_px()), sigma_px,
       blurred_);
}

float CameraRenderer::light_at(const VehicleView& vehicle, int x, int y,
                               const Patches& patches) const {
  double light = 0.0;
  for (const Patch& patch : patches) {
    light += patch.share * (patch.surface == kNothing ? backdrop_light(vehicle, x, y)
                                                      : vehicle.radiance(patch).total());
  }
  return static_cast<float>(light);
}

// The backdrop of a pixel with the vehicle's shadow on the part that is ground.
double CameraRenderer::backdrop_light(const VehicleView& vehicle, int x, int y) const {
  const auto plain = static_cast<double>(plain_.at(x, y));
  const auto ground = static_cast<double>(backdrop_.ground.at(x, y));
  const Eigen::Vector3d direction = rays_.inside(x, y, 0.5, 0.5);
  if (ground == 0.0 || direction.z() >= 0.0) return plain;
  const Eigen::Vector3d p = camera_.centre_m() - camera_.centre_m().z() / direction.z() * direction;
  const VehicleView::Shade shade = vehicle.shade_on_ground(p);
  const double shaded = shade.key * static_cast<double>(backdrop_.key.at(x, y)) +
                        shade.rest * static_cast<double>(backdrop_.rest.at(x, y));
  return plain + ground * (shaded - plain);
}

}  // namespace dottrack::host_sim
