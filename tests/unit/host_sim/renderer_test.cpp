// Rendered dots are where geometry says, and pictures are the same whoever renders them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host_sim/renderer/camera_renderer.h"
#include "host_sim/scenarios/ceiling.h"
#include "host_sim/scenarios/scenes.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDark = 0.05;
constexpr double kWhite = 0.80;

// A sensor that adds nothing but rounding.
SensorModel plain_sensor(double blur_sigma_px) {
  SensorModel sensor;
  sensor.blur_sigma_px = blur_sigma_px;
  sensor.corner_falloff = 0.0;
  sensor.noise = false;
  return sensor;
}

// A dark floor under even light.
World dark_world() {
  World world;
  world.lighting.key = {{0.0, 0.0, 20.0}, 0.0};
  world.lighting.ambient = 1.0;
  const std::vector<Vector2d> outline = {{-20, -20}, {20, -20}, {20, 20}, {-20, 20}};
  world.objects.push_back(
      make_object(make_outline({0.0, 0.0, 0.01}, Vector3d::UnitX(), Vector3d::UnitY(), outline),
                  {kDark, Pattern::plain, 0.0, 0}));
  return world;
}

struct Centre {
  Vector2d pixel = Vector2d::Zero();
  double area_px = 0.0;
};

// Centroid of what is brighter than the floor, in a window around a place.
Centre measure(const GreyImage& image, const Vector2d& around) {
  const int reach = 14;
  const int x0 = static_cast<int>(std::lround(around.x()));
  const int y0 = static_cast<int>(std::lround(around.y()));
  const double floor_dn = image.at(x0 - reach, y0 - reach);
  Centre centre;
  for (int y = y0 - reach; y <= y0 + reach; ++y) {
    for (int x = x0 - reach; x <= x0 + reach; ++x) {
      const double excess = image.at(x, y) - floor_dn;
      centre.pixel += excess * Vector2d(x, y);
      centre.area_px += excess;
    }
  }
  centre.pixel /= centre.area_px;
  centre.area_px /= 255.0 * (kWhite - kDark);
  return centre;
}

// Centroid and area of the disc's image, from its outline projected point by point.
Centre expected(const SimCamera& camera, const Disc& disc) {
  const Vector3d u = disc.normal.unitOrthogonal();
  const Vector3d v = disc.normal.cross(u);
  constexpr int kPoints = 720;
  const Vector2d origin = *camera.project(disc.centre);
  Centre sum;
  Vector2d last = Vector2d::Zero();
  for (int i = 0; i <= kPoints; ++i) {
    const double angle = 2.0 * kPi * i / kPoints;
    const Vector3d p = disc.centre + disc.radius_m * (std::cos(angle) * u + std::sin(angle) * v);
    const Vector2d here = *camera.project(p) - origin;
    if (i > 0) {
      const double cross = last.x() * here.y() - last.y() * here.x();
      sum.area_px += 0.5 * cross;
      sum.pixel += cross / 6.0 * (last + here);
    }
    last = here;
  }
  return {origin + sum.pixel / sum.area_px, std::abs(sum.area_px)};
}

bool well_inside(const SimCamera& camera, const Vector2d& pixel) {
  return pixel.x() > 16 && pixel.y() > 16 && pixel.x() < camera.width_px() - 17 &&
         pixel.y() < camera.height_px() - 17;
}

TEST(RendererTest, ADotSeenSquarelyIsAtItsCentresProjection) {
  for (int i = 0; i < 12; ++i) {
    World world = dark_world();
    const Disc disc{{0.013 * i, -0.017 * i, 0.02}, Vector3d::UnitZ(), 0.05};
    world.objects.push_back(make_mark(disc, kWhite));
    const Vector3d eye(0.0, 0.0, 5.0);
    const SimCamera camera(eye, looking_at(eye, Vector3d::Zero(), 0.1, Vector3d::UnitX()), {}, 640,
                           480);
    CameraRenderer renderer(world, camera, plain_sensor(0.6));
    GreyImage image;
    renderer.render({}, {}, image);
    const Vector2d centre = *camera.project(disc.centre);
    const Centre measured = measure(image, centre);
    EXPECT_LT((measured.pixel - centre).norm(), 0.01) << i;
    const double radius_px = camera.lens().focal_x_px * 0.05 / 4.98;
    EXPECT_NEAR(measured.area_px, kPi * radius_px * radius_px, 0.3) << i;
  }
}

// Oblique and through distorting lenses, the centroid of the image is not the centre's image;
// both on the floor and carried by the vehicle.
TEST(RendererTest, ADotSeenFromAsideIsWhereItsOutlineSays) {
  int dots = 0;
  double squares = 0.0;
  for (const SceneCamera& scene_camera : ceiling_cameras({.seed = 2})) {
    const SimCamera& camera = scene_camera.camera;
    World world = dark_world();
    world.vehicle = Vehicle{{}, {}, {-1.0, -1.0, 0.0}, {1.0, 1.0, 1.0}};
    const Pose pose = pose_at(starting_at({}, {0.3, -0.4}, 0.7), 0.0);
    RandomStream random(9, static_cast<std::uint64_t>(dots));
    std::vector<Disc> discs;
    for (int i = 0; i < 24; ++i) {  // 1.5 m apart on the floor, 0.5 m on the vehicle
      const double x = i % 6 - 2.5 + random.uniform(-0.1, 0.1);
      const double y = i / 6 - 1.5 + random.uniform(-0.1, 0.1);
      const bool on_vehicle = std::abs(x) < 0.9 && std::abs(y) < 0.9;
      const Disc disc{{x, y, on_vehicle ? 0.5 : 0.02}, Vector3d::UnitZ(), 0.05};
      if (on_vehicle) {
        world.vehicle->objects.push_back(make_mark(disc, kWhite));
        discs.push_back({pose.to_world(disc.centre), pose.rotation.col(2), 0.05});
      } else {
        world.objects.push_back(make_mark(disc, kWhite));
        discs.push_back(disc);
      }
    }
    CameraRenderer renderer(world, camera, plain_sensor(0.6));
    GreyImage image;
    renderer.render(pose, {}, image);
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const auto seen = camera.project(discs[i].centre);
      if (!seen || !well_inside(camera, *seen)) continue;
      const bool crowded = std::any_of(discs.begin(), discs.end(), [&](const Disc& other) {
        const auto pixel = camera.project(other.centre);
        const double gap_px = pixel ? (*pixel - *seen).lpNorm<Eigen::Infinity>() : 1e9;
        return gap_px > 0.0 && gap_px < 32.0;
      });
      if (crowded) continue;
      const Centre wanted = expected(camera, discs[i]);
      const Centre measured = measure(image, wanted.pixel);
      // Rounding to whole grey levels alone shifts the smallest by 0.02 px.
      const double bound_px = wanted.area_px < 20.0 ? 0.035 : 0.02;
      EXPECT_LT((measured.pixel - wanted.pixel).norm(), bound_px) << scene_camera.name << " " << i;
      EXPECT_NEAR(measured.area_px / wanted.area_px, 1.0, 0.02) << scene_camera.name << " " << i;
      squares += (measured.pixel - wanted.pixel).squaredNorm();
      ++dots;
    }
  }
  EXPECT_GE(dots, 60);
  const double rms_px = std::sqrt(squares / std::max(dots, 1));
  EXPECT_LT(rms_px, 0.008);
  RecordProperty("rms_px", std::to_string(rms_px));
}

RandomSceneOptions small_scene() {
  return {.seed = 11, .dots = 5, .cameras = 3, .width_px = 160, .height_px = 120};
}

TEST(RendererTest, BytesDependOnNeitherThreadsNorOrder) {
  const Scene scene = make_random_scene(small_scene());
  SceneRenderer one(scene, 1);
  SceneRenderer many(scene, 3);
  std::vector<GreyImage> a;
  std::vector<GreyImage> b;
  one.render(0, a);
  one.render(2, a);
  many.render(2, b);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].pixels(), b[i].pixels()) << i;
}

TEST(RendererTest, TicksCamerasAndSeedsHaveNoiseOfTheirOwn) {
  Scene scene = make_random_scene(
      {.seed = 12, .with_vehicle = false, .cameras = 2, .width_px = 80, .height_px = 60});
  SceneRenderer renderer(scene);
  GreyImage first;
  GreyImage second;
  renderer.render_camera(0, 0, first);
  renderer.render_camera(0, 1, second);
  EXPECT_NE(first.pixels(), second.pixels());
  scene.seed = 13;
  renderer.render_camera(0, 0, second);
  EXPECT_NE(first.pixels(), second.pixels());
}

TEST(RendererTest, TheVehicleHidesWhatIsUnderItAndThrowsAShadow) {
  RandomSceneOptions options = small_scene();
  options.width_px = 320;
  options.height_px = 240;
  Scene scene = make_random_scene(options);
  for (SceneCamera& camera : scene.cameras) camera.sensor.noise = false;
  Scene empty = scene;
  empty.world.vehicle.reset();
  std::vector<GreyImage> with;
  std::vector<GreyImage> without;
  SceneRenderer(scene).render(0, with);
  SceneRenderer(empty).render(0, without);
  for (std::size_t i = 0; i < with.size(); ++i) {
    int darker = 0;
    int brighter = 0;
    for (std::size_t p = 0; p < with[i].pixels().size(); ++p) {
      darker += with[i].pixels()[p] + 15 < without[i].pixels()[p] ? 1 : 0;
      brighter += with[i].pixels()[p] > without[i].pixels()[p] + 15 ? 1 : 0;
    }
    EXPECT_GT(darker, 500) << i;  // the deck and the shadow on the sand
    EXPECT_GT(brighter, 5) << i;  // the dots
  }
}

std::uint64_t fingerprint(const GreyImage& image) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const std::uint8_t pixel : image.pixels()) hash = (hash ^ pixel) * 0x100000001B3ULL;
  return hash;
}

// Changes with every change of the scenes' looks; never with the machine, compiler or options.
TEST(RendererTest, TheBytesAreTheSameEverywhere) {
  const Scene scene = make_random_scene(small_scene());
  std::vector<GreyImage> images;
  SceneRenderer(scene).render(1, images);
  EXPECT_EQ(fingerprint(images[0]), 15705935331500819422ULL);
}

}  // namespace
}  // namespace dottrack::host_sim
