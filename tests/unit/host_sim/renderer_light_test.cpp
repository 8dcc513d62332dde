// Light adds up, and shadows fall where geometry says and take away what they should.

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/unit/host_sim/renderer_bench.h"

namespace dottrack::host_sim {
namespace {

using namespace bench;

Model white_floor() {
  return {{plate(Vector3d::Zero(), 20.0, 20.0, 0.8)}, {}};
}

int level_at(const GreyImage& image, const Vector3d& p) {
  const Vector2d pixel = *overhead().project(p);
  return image.at(static_cast<int>(std::lround(pixel.x())),
                  static_cast<int>(std::lround(pixel.y())));
}

TEST(RendererLightTest, AFloorIsAsBrightAsItsLampsSay) {
  const Vector3d lamp_at(1.0, 0.5, 4.0);
  const Hall hall(white_floor(), {lamp_above("a", lamp_at, 0.2, 0.5), glow(0.1)});
  CameraView view(hall, overhead(), plain_sensor());
  const GreyImage image = picture(view);
  for (const Vector3d& p :
       {Vector3d(0.0, 0.0, 0.0), Vector3d(1.0, 0.5, 0.0), Vector3d(-1.0, 0.8, 0.0)}) {
    const double cosine = lamp_at.z() / (lamp_at - p).norm();
    const double direct = 0.5 * cosine * cosine * cosine * cosine;  // 1/r^2 and two cosines
    EXPECT_NEAR(level_at(image, p), 255.0 * 0.8 * (direct + 0.1), 1.0);
  }
}

TEST(RendererLightTest, LampsAddUpAndLevelsScaleThem) {
  const Hall hall(white_floor(), {lamp_above("a", {1.0, 0.5, 4.0}, 0.2, 0.4),
                                  lamp_above("b", {-1.5, 0.0, 4.0}, 0.2, 0.3)});
  CameraView view(hall, overhead(), plain_sensor(0.6));
  const Moving body({{box({0.0, 0.0, 0.5}, {0.3, 0.2, 0.1}, 0.4)}, {}}, standing({}));
  const auto with = [&](double a, double b) {
    const LightPlan plan{{{"a", 0.0, a}, {"b", 0.0, b}}};
    return picture(view, {body.body()}, plan);
  };
  const GreyImage both = with(1.0, 1.0);
  const GreyImage only_a = with(1.0, 0.0);
  const GreyImage only_b = with(0.0, 1.0);
  const GreyImage half = with(0.5, 0.5);
  int most = 0;
  for (std::size_t i = 0; i < both.pixels().size(); ++i) {
    const int sum = only_a.pixels()[i] + only_b.pixels()[i];
    EXPECT_LE(std::abs(both.pixels()[i] - sum), 4) << i;
    EXPECT_LE(std::abs(both.pixels()[i] - 2 * half.pixels()[i]), 4) << i;
    most = std::max(most, sum);
  }
  EXPECT_GT(most, 100);
}

TEST(RendererLightTest, AFadeIsRenderedRowByRowByARollingShutter) {
  const Hall hall({{plate(Vector3d::Zero(), 20.0, 20.0, 0.8)}, {}}, {glow(0.8)});
  SensorModel sensor = plain_sensor();
  sensor.line_time_s = 1e-4;
  CameraView view(hall, overhead(), sensor);
  const LightPlan plan{{{"glow", 0.0, 0.0}, {"glow", 1.0, 1.0, 0.1}}};
  const GreyImage image = picture(view, {}, plan, {.middle_s = 1.05});
  for (const int row : {0, 60, 119, 200, 239}) {
    const double level = 0.5 + (row - 119.5) * 1e-3;
    EXPECT_NEAR(image.at(160, row), 255.0 * 0.8 * 0.8 * level, 1.0) << row;
  }
}

class ShadowTest : public testing::TestWithParam<bool> {};

// A plate 1 m over the floor, moving or standing, between it and one of two lamps: the shadow's
// middle lies where the line from the lamp through the plate's middle meets the floor, and there
// the other lamp's light is left.
TEST_P(ShadowTest, FallsWhereItShouldAndTakesItsLampsShare) {
  const Vector3d lamp_at(2.5, 0.0, 4.0);
  const Vector3d plate_at(0.45, 0.0, 1.0);
  const std::vector<Lamp> lamps = {lamp_above("a", lamp_at, 0.1, 0.5), glow(0.2)};
  Model floor = white_floor();
  const Part shade = plate(GetParam() ? Vector3d::Zero() : plate_at, 0.2, 0.3, 0.8);
  if (!GetParam()) floor.parts.push_back(shade);
  const Moving body({{shade}, {}}, standing({plate_at, Eigen::Matrix3d::Identity()}));
  const Hall hall(floor, lamps);
  CameraView view(hall, overhead(), plain_sensor());
  const GreyImage image = GetParam() ? picture(view, {body.body()}) : picture(view);
  const Hall bare_hall(white_floor(), lamps);
  CameraView bare(bare_hall, overhead(), plain_sensor());
  const GreyImage lit = picture(bare);

  const Vector3d middle = lamp_at + 4.0 / 3.0 * (plate_at - lamp_at);
  EXPECT_NEAR(level_at(image, middle), 255.0 * 0.8 * 0.2, 1.0);
  // Seen from the lamp, 0.2 m at 3 m cover 0.267 m of the floor; 0.03 m of half shadow around.
  for (const double side : {-1.0, 1.0}) {
    const Vector3d inside = middle + Vector3d(side * 0.2, side * 0.3, 0.0);
    EXPECT_NEAR(level_at(image, inside), 255.0 * 0.8 * 0.2, 1.0) << side;
    const Vector3d outside = middle + Vector3d(side * 0.33, 0.0, 0.0);
    EXPECT_EQ(level_at(image, outside), level_at(lit, outside)) << side;
    const Vector3d edge = middle + Vector3d(0.0, side * 0.4, 0.0);
    const double half_lit = 0.5 * (level_at(lit, edge) + 255.0 * 0.8 * 0.2);
    EXPECT_NEAR(level_at(image, edge), half_lit, 25.0) << side;
    const Vector3d beyond = middle + Vector3d(0.0, side * 0.47, 0.0);
    EXPECT_EQ(level_at(image, beyond), level_at(lit, beyond)) << side;
  }
  const Vector3d far_away(-1.2, -0.9, 0.0);
  EXPECT_EQ(level_at(image, far_away), level_at(lit, far_away));
}

INSTANTIATE_TEST_SUITE_P(StandingAndMoving, ShadowTest, testing::Bool());

// A body in the shadow of what stands still, and in its own.
TEST(RendererLightTest, BodiesAreShadedByTheHallAndByThemselves) {
  Model floor = white_floor();
  floor.parts.push_back(plate({0.0, 0.5, 2.0}, 0.3, 0.3, 0.8));
  const Hall hall(floor, {lamp_above("a", {0.0, 0.5, 4.0}, 0.05, 0.5), glow(0.2)});
  const SimCamera camera = camera_over({0.0, -4.0, 3.0}, {0.0, 0.3, 0.5});
  CameraView view(hall, camera, plain_sensor());
  // A lower deck, half of it under an upper one.
  const Moving body({{plate({0.9, 0.5, 0.3}, 0.5, 0.4, 0.8), plate({1.1, 0.5, 0.8}, 0.2, 0.4, 0.8),
                      plate({0.0, 0.5, 0.3}, 0.25, 0.25, 0.8)},
                     {}},
                    standing({}));
  const GreyImage image = picture(view, {body.body()});
  const auto at = [&](const Vector3d& p) {
    const Vector2d pixel = *camera.project(p);
    return static_cast<int>(image.at(static_cast<int>(std::lround(pixel.x())),
                                     static_cast<int>(std::lround(pixel.y()))));
  };
  const double dark = 255.0 * 0.8 * 0.2;
  EXPECT_NEAR(at({0.0, 0.5, 0.3}), dark, 1.0);    // under the hall's plate
  EXPECT_GT(at({0.7, 0.5, 0.3}), 2.0 * dark);     // in the light
  EXPECT_NEAR(at({1.25, 0.35, 0.3}), dark, 1.0);  // under its own upper deck
  EXPECT_GT(at({1.1, 0.5, 0.8}), 2.0 * dark);
}

}  // namespace
}  // namespace dottrack::host_sim
