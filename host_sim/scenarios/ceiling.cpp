#include "host_sim/scenarios/ceiling.h"

#include <array>

#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// In halves of the floor's sides.
constexpr std::array<std::array<double, 2>, 8> kSpots = {{{-0.94, 0.94},
                                                          {0.94, 0.94},
                                                          {0.94, -0.94},
                                                          {-0.94, -0.94},
                                                          {0.05, 1.02},
                                                          {-0.05, -1.02},
                                                          {1.02, 0.05},
                                                          {-1.02, -0.05}}};

Lens make_lens(RandomStream& random, int width_px, int height_px) {
  Lens lens;
  const double field_rad = radians(random.uniform(62.0, 76.0));
  lens.focal_x_px = 0.5 * width_px / tangent(0.5 * field_rad);
  lens.focal_y_px = lens.focal_x_px * random.uniform(0.998, 1.002);
  lens.centre_x_px = 0.5 * (width_px - 1) + random.uniform(-6.0, 6.0);
  lens.centre_y_px = 0.5 * (height_px - 1) + random.uniform(-5.0, 5.0);
  lens.axis = Vector3d{random.uniform(-0.008, 0.008), random.uniform(-0.008, 0.008), 1.0};
  lens.radial = {random.uniform(-0.001, 0.001), random.uniform(-0.16, -0.08),
                 random.uniform(0.015, 0.03)};
  return lens;
}

SceneCamera make_camera(const CeilingOptions& options, std::size_t spot) {
  RandomStream random(options.seed, 0xCA0 + spot);
  const Vector3d centre{kSpots[spot][0] * options.half_length_m + random.uniform(-0.15, 0.15),
                        kSpots[spot][1] * options.half_width_m + random.uniform(-0.15, 0.15),
                        options.height_m + random.uniform(-0.2, 0.2)};
  const Vector3d aim{0.12 * centre.x() + random.uniform(-0.2, 0.2),
                     0.12 * centre.y() + random.uniform(-0.2, 0.2), 0.2};
  const Eigen::Matrix3d rotation = looking_at(centre, aim, radians(random.uniform(-4.0, 4.0)));
  const Lens lens = make_lens(random, options.width_px, options.height_px);
  SensorModel sensor;
  sensor.exposure = random.uniform(0.95, 1.10);
  return {"cam" + std::to_string(spot + 1),
          SimCamera(centre, rotation, lens, options.width_px, options.height_px), sensor};
}

}  // namespace

std::vector<SceneCamera> ceiling_cameras(const CeilingOptions& options) {
  std::vector<SceneCamera> cameras;
  for (std::size_t spot = 0; spot < kSpots.size(); ++spot) {
    if (static_cast<int>(spot) < options.cameras) cameras.push_back(make_camera(options, spot));
  }
  return cameras;
}

Lighting hall_lighting(std::uint64_t seed) {
  RandomStream random(seed, 0x11647);
  Lighting lighting;
  const double azimuth = random.uniform(0.0, 2.0 * kPi);
  lighting.key = {{15.0 * cosine(azimuth), 15.0 * sine(azimuth), 14.0}, 400.0};
  lighting.key_radius_m = 0.9;
  for (const double x : {-2.4, 2.4}) {
    for (const double y : {-1.7, 1.7}) {
      lighting.fill.push_back({{x, y, 5.6}, random.uniform(2.2, 4.0)});
    }
  }
  lighting.ambient = 0.26;
  return lighting;
}

}  // namespace dottrack::host_sim
