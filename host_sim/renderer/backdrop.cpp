#include "host_sim/renderer/backdrop.h"

#include "host_sim/renderer/pixel_sampler.h"
#include "host_sim/renderer/radiance.h"
#include "host_sim/renderer/shadow.h"

namespace dottrack::host_sim {
namespace {

class Painter {
 public:
  Painter(const World& world, const SimCamera& camera)
      : world_(world), camera_(camera), shadows_(world.objects, world.lighting) {}

  Radiance radiance(const Patch& patch) const {
    if (patch.surface == kNothing) return {};
    const Eigen::Vector3d p = camera_.centre_m() + patch.distance * patch.direction;
    const double footprint_m = patch.distance * patch.direction.norm() / camera_.lens().focal_x_px;
    return patch.surface == kGround ? of_ground(p)
                                    : of_object(patch, {p, p, patch.normal, footprint_m});
  }

 private:
  Radiance of_ground(const Eigen::Vector3d& p) const {
    const Eigen::Vector2d xy = p.head<2>();
    const double albedo = world_.ground.albedo_at(xy);
    const Illumination light = illuminate(world_.lighting, p, world_.ground.normal_at(xy));
    const double lit = shadows_.visible_share(p, Eigen::Vector3d::UnitZ());
    return {albedo * light.key * lit, albedo * light.rest};
  }

  Radiance of_object(const Patch& patch, const SurfacePoint& point) const {
    const Object& object = world_.objects[static_cast<std::size_t>(patch.surface - kFirstObject)];
    Radiance radiance = radiance_of(object.material, point, world_.lighting, camera_.centre_m());
    radiance.key *= shadows_.visible_share(point.p_world, point.normal);
    return radiance;
  }

  const World& world_;
  const SimCamera& camera_;
  StillShadows shadows_;
};

}  // namespace

Backdrop paint_backdrop(const World& world, const SimCamera& camera, const RayLattice& rays,
                        const StillLife& still) {
  const int width_px = camera.width_px();
  const int height_px = camera.height_px();
  const auto cast = [&](int x, int y, const Eigen::Vector3d& direction) {
    return still.cast(x, y, direction);
  };
  const auto is_mark = [&](int surface) {
    return surface >= kFirstObject &&
           world.objects[static_cast<std::size_t>(surface - kFirstObject)].is_mark;
  };
  const Painter painter(world, camera);
  const PixelSampler sampler(rays, {0, 0, width_px, height_px}, cast, is_mark);
  Backdrop backdrop{FloatImage(width_px, height_px), FloatImage(width_px, height_px),
                    FloatImage(width_px, height_px)};
  Patches patches;
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      sampler.sample(x, y, patches);
      for (const Patch& patch : patches) {
        const Radiance radiance = painter.radiance(patch);
        backdrop.key.at(x, y) += static_cast<float>(patch.share * radiance.key);
        backdrop.rest.at(x, y) += static_cast<float>(patch.share * radiance.rest);
        if (patch.surface == kGround) backdrop.ground.at(x, y) += static_cast<float>(patch.share);
      }
    }
  }
  return backdrop;
}

}  // namespace dottrack::host_sim
