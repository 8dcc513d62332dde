// Rendered dots are where geometry says.

#include <gtest/gtest.h>

#include <string>

#include "host_sim/world/random.h"
#include "tests/unit/host_sim/renderer_bench.h"

namespace dottrack::host_sim {
namespace {

using namespace bench;

struct DotView {
  SimCamera camera;
  Vector3d aim_m;
};

// From 3 to 6 m up, up to 50 degrees from the vertical.
DotView random_view(RandomStream& random, LensKind kind) {
  Lens lens;
  lens.kind = kind;
  lens.focal_x_px = random.uniform(420.0, 560.0);
  lens.focal_y_px = lens.focal_x_px * random.uniform(0.98, 1.02);
  lens.centre_x_px = 119.5 + random.uniform(-5.0, 5.0);
  lens.centre_y_px = 89.5 + random.uniform(-5.0, 5.0);
  lens.radial = {0.0, random.uniform(-0.15, 0.1), 0.02};
  const Vector3d eye{random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0),
                     random.uniform(3.0, 6.0)};
  const Vector3d aim{eye.x() + random.uniform(-2.0, 2.0), eye.y() + random.uniform(-2.0, 2.0), 0.0};
  return {SimCamera(eye, looking_at(eye, aim, random.uniform(-3.0, 3.0), Vector3d::UnitY()), lens,
                    240, 180),
          aim};
}

// Where a window around a dot fits into the picture.
bool well_inside(const SimCamera& camera, const Vector2d& pixel) {
  return pixel.x() > 22 && pixel.y() > 22 && pixel.x() < camera.width_px() - 23 &&
         pixel.y() < camera.height_px() - 23;
}

struct Errors {
  int dots = 0;
  double squares = 0.0;

  void note(const GreyImage& image, const Centre& wanted, const std::string& what) {
    const double off_px = (measure(image, wanted.pixel).pixel - wanted.pixel).norm();
    EXPECT_LT(off_px, 0.01) << what;
    ++dots;
    squares += off_px * off_px;
  }
  double rms_px() const { return std::sqrt(squares / std::max(dots, 1)); }
};

class RendererMarksTest : public testing::TestWithParam<double> {};

// A dot on the floor, and one on a tilted body, in 30 views each through two kinds of lens. With
// the rounding to whole grey levels, 0.003 px RMS and 0.008 px at most were measured.
TEST_P(RendererMarksTest, CentroidsAreThoseOfTheProjectedOutlines) {
  Errors still;
  Errors moving;
  for (std::uint64_t i = 0; i < 30; ++i) {
    RandomStream random(7, i);
    const auto [camera, aim] =
        random_view(random, i % 2 == 0 ? LensKind::radial : LensKind::fisheye);
    const double radius_m = random.uniform(0.03, 0.07);
    const Vector3d on_floor{aim.x() + random.uniform(-0.2, 0.2), aim.y() - 0.3, 0.0};
    Model model = dark_floor();
    model.marks.push_back(dot(on_floor, radius_m));
    const Hall hall(model, {glow(1.2)});
    CameraView view(hall, camera, plain_sensor(GetParam()));
    if (well_inside(camera, *camera.project(on_floor))) {
      const Centre wanted = expected(camera, on_floor, Vector3d::UnitZ(), radius_m);
      const GreyImage image = picture(view);
      still.note(image, wanted, "floor " + std::to_string(i));
      EXPECT_NEAR(measure(image, wanted.pixel).area_px / wanted.area_px, 1.0, 0.01) << i;
    }
    const Vector3d axis{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 0.3};
    const Eigen::AngleAxisd tilt(random.uniform(0.1, 0.4), axis.normalized());
    const Pose pose{aim + Vector3d(0.0, random.uniform(0.0, 0.3), 0.5), tilt.toRotationMatrix()};
    const Moving body({{plate(Vector3d::Zero(), 1.5, 1.5, 0.0)}, {dot(Vector3d::Zero(), radius_m)}},
                      standing(pose));
    if (!well_inside(camera, *camera.project(pose.position_m))) continue;
    moving.note(picture(view, {body.body()}),
                expected(camera, pose.position_m, pose.rotation.col(2), radius_m),
                "body " + std::to_string(i));
  }
  EXPECT_GE(still.dots, 20);
  EXPECT_GE(moving.dots, 20);
  EXPECT_LT(still.rms_px(), 0.005);
  EXPECT_LT(moving.rms_px(), 0.005);
  RecordProperty("still_rms_px", std::to_string(still.rms_px()));
  RecordProperty("moving_rms_px", std::to_string(moving.rms_px()));
}

INSTANTIATE_TEST_SUITE_P(SharpAndBlurred, RendererMarksTest, testing::Values(0.0, 0.7));

}  // namespace
}  // namespace dottrack::host_sim
