#include "app/core/geometry/pixel_bundle.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/geometry/random_cameras.h"

namespace dottrack::geometry {
namespace {

constexpr int kCameras = 200;

struct Seen {
  int known = 0;
  int valid = 0;  // that unproject knows
};

void compare(const CameraModel& model, const PixelBundle& bundle, Seen& seen) {
  for (std::size_t i = 0; i < bundle.size; ++i) {
    Ray ray;
    const bool valid = unproject(model, {bundle.x[i], bundle.y[i]}, ray) == OpticsStatus::ok;
    seen.valid += valid ? 1 : 0;
    if (bundle.known[i] == 0) continue;
    ++seen.known;
    ASSERT_TRUE(valid);
    const Ray line = bundle.ray(i, model);
    EXPECT_EQ(line.origin, ray.origin);
    EXPECT_LT((line.direction - ray.direction).norm(), 1e-12);
    constexpr double kRange_m = 3.0;
    Eigen::Vector2d pixel;
    ProjectionJacobian jacobian;
    ASSERT_EQ(project(model, ray.origin + kRange_m * ray.direction, pixel, &jacobian),
              OpticsStatus::ok);
    // The axes are not quite of unit length: project and unproject are inverse to as much.
    EXPECT_LT((kRange_m * jacobian - bundle.pixels_per_rad(i)).norm(), 3e-5 * jacobian.norm());
  }
}

// Pixels in the image and around it, and one that is none.
PixelBundle pixels_of(test::RandomCameras& random, std::size_t size) {
  PixelBundle bundle;
  bundle.size = size;
  for (std::size_t i = 0; i < size; ++i) {
    bundle.x[i] = random.between(-300.0, 1000.0);
    bundle.y[i] = random.between(-300.0, 1000.0);
  }
  bundle.x[size / 2] = std::numeric_limits<double>::quiet_NaN();
  return bundle;
}

TEST(PixelBundle, AgreesWithOnePixelAtATime) {
  test::RandomCameras random(31);
  Seen seen;
  for (int camera = 0; camera < kCameras; ++camera) {
    const CameraModel model =
        camera % 4 == 0 ? CameraModel(random.cahv()) : CameraModel(random.cahvor());
    PixelBundle bundle = pixels_of(random, 1 + static_cast<std::size_t>(camera) % 64);
    unproject_bundle(model, bundle);
    compare(model, bundle, seen);
  }
  EXPECT_GT(seen.valid, 4000);
  EXPECT_GE(seen.known, seen.valid * 8 / 10);
}

TEST(PixelBundle, KnowsNothingOfLensesWithAMovingPupil) {
  test::RandomCameras random(32);
  PixelBundle bundle = pixels_of(random, 64);
  bundle.known.fill(1);
  unproject_bundle(random.cahvore(0.5), bundle);
  for (const std::uint8_t known : bundle.known) EXPECT_EQ(known, 0);
}

}  // namespace
}  // namespace dottrack::geometry
