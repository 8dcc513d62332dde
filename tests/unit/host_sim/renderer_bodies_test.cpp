// What moves: in front, behind, smeared, sheared, and the same bytes however it is rendered.

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/unit/host_sim/renderer_bench.h"

namespace dottrack::host_sim {
namespace {

using namespace bench;

Motion sliding(const Vector3d& from_m, const Vector3d& velocity_m_s) {
  return [=](double time_s) {
    return Pose{from_m + time_s * velocity_m_s, Eigen::Matrix3d::Identity()};
  };
}

// A plate that hides the half of a dot's picture hides half of its light, whichever of the two
// moves.
TEST(RendererBodiesTest, APlateHidesTheShareOfADotThatItCovers) {
  const Vector3d dot_at(0.2, -0.1, 0.0);
  const double radius_m = 0.08;
  const Vector3d eye = overhead().centre_m();
  const Vector3d over_dot = dot_at + 0.1 * (eye - dot_at);  // on the line of sight to its middle
  for (const double covered_m : {-0.08, -0.03, 0.0, 0.05}) {
    // The plate's edge in the dot's plane, from the dot's middle; a circle's segment is left.
    const Part cover =
        plate(over_dot + Vector3d(-0.3 + 0.9 * covered_m, 0.0, 0.0), 0.3, 0.3, kDark);
    const double x = covered_m / radius_m;
    const double left = 0.5 - (x * std::sqrt(1.0 - x * x) + std::asin(x)) / kPi;
    Model dotted = dark_floor();
    dotted.marks.push_back(dot(dot_at, radius_m));
    const double whole_px = expected(overhead(), dot_at, Vector3d::UnitZ(), radius_m).area_px;
    const auto check = [&](const GreyImage& image, const char* what) {
      const Vector2d pixel = *overhead().project(dot_at);
      double excess = 0.0;
      for (int y = -14; y <= 14; ++y) {
        for (int x_px = -14; x_px <= 14; ++x_px) {
          excess +=
              image.at(static_cast<int>(pixel.x()) + x_px, static_cast<int>(pixel.y()) + y) - 15.0;
        }
      }
      EXPECT_NEAR(excess / (245.0 - 15.0) / whole_px, left, 0.012) << what << covered_m;
    };
    const Hall with_dot(dotted, {glow(1.2)});
    const Moving cover_body({{cover}, {}}, standing({}));
    CameraView one(with_dot, overhead(), plain_sensor());
    check(picture(one, {cover_body.body()}), "moving plate ");

    Model covered = dark_floor();
    covered.parts.push_back(cover);
    const Hall with_cover(covered, {glow(1.2)});
    const Moving dot_body({{plate({0.2, -0.1, 0.0}, 0.2, 0.2, kDark)}, {dot(dot_at, radius_m)}},
                          standing({Vector3d(0.0, 0.0, 1e-3), Eigen::Matrix3d::Identity()}));
    CameraView two(with_cover, overhead(), plain_sensor());
    check(picture(two, {dot_body.body()}), "moving dot ");

    covered.marks.push_back(dot(dot_at, radius_m));
    const Hall all_still(covered, {glow(1.2)});
    CameraView three(all_still, overhead(), plain_sensor());
    check(picture(three), "both still ");
  }
}

TEST(RendererBodiesTest, ABodyBehindAWallIsNotSeen) {
  Model model = dark_floor();
  model.parts.push_back(box({0.0, 0.0, 2.0}, {0.5, 0.5, 0.05}, 0.3));
  const Hall hall(model, {glow(1.2)});
  CameraView view(hall, overhead(), plain_sensor());
  const GreyImage empty = picture(view);
  const Moving hidden({{box({0.0, 0.0, 1.0}, {0.2, 0.2, 0.2}, 0.9)}, {}}, standing({}));
  EXPECT_EQ(picture(view, {hidden.body()}).pixels(), empty.pixels());
  const Moving above({{box({0.0, 0.0, 2.5}, {0.2, 0.2, 0.2}, 0.9)}, {}}, standing({}));
  EXPECT_NE(picture(view, {above.body()}).pixels(), empty.pixels());
  const Moving away({{box({0.0, 0.0, 2.5}, {0.2, 0.2, 0.2}, 0.9)}, {}},
                    [](double) { return std::nullopt; });
  EXPECT_EQ(picture(view, {away.body()}).pixels(), empty.pixels());
}

Model contraption() {
  Model model{
      {box({0.0, 0.0, 0.4}, {0.5, 0.35, 0.05}, 0.15), box({0.0, 0.2, 0.2}, {0.4, 0.05, 0.2}, 0.4),
       plate({0.1, -0.1, 0.9}, 0.12, 0.1, 0.6)},
      {}};
  model.parts.push_back({Balls{{{0.3F, 0.2F, 0.6F, 0.12F}}}, {.albedo = 0.5, .gloss = 0.2}});
  model.parts.push_back(
      {Cable{{{-0.3F, -0.2F, 0.4F, 0.03F}, {-0.35F, -0.2F, 1.2F, 0.02F}}}, {.albedo = 0.7}});
  model.marks.push_back(dot({-0.1, 0.0, 0.45}, 0.06));
  model.marks.push_back(dot({0.25, -0.2, 0.45}, 0.06));
  return model;
}

std::vector<Lamp> three_lamps() {
  return {lamp_above("a", {1.5, 0.0, 4.0}, 0.1, 0.4), lamp_above("b", {-1.0, 1.0, 4.5}, 0.6, 0.3),
          lamp_above("c", {0.2, -1.5, 4.5}, 0.3, 0.2), glow(0.15)};
}

Model furnished() {
  Model model{{plate(Vector3d::Zero(), 20.0, 20.0, 0.4)}, {}};
  model.parts.push_back(box({0.5, 0.6, 0.3}, {0.2, 0.1, 0.3}, 0.6));
  model.parts.push_back(box({-0.5, -0.5, 1.5}, {0.3, 0.02, 0.02}, 0.6));
  return model;
}

// The body rendered into the still picture, and the same model as a part of the hall.
TEST(RendererBodiesTest, ABodyLooksAsIfItWereBuiltIn) {
  const Model thing = contraption();
  Model built_in = furnished();
  const std::size_t first = built_in.parts.size();
  for (const Part& part : thing.parts) built_in.parts.push_back(part);
  for (Mark mark : thing.marks) {
    mark.part += first;
    built_in.marks.push_back(mark);
  }
  const Hall one(built_in, three_lamps());
  const Hall other(furnished(), three_lamps());
  const SimCamera camera = camera_over({1.8, -2.5, 3.0}, {0.0, 0.0, 0.2});
  CameraView all(one, camera, plain_sensor(0.6));
  CameraView hall(other, camera, plain_sensor(0.6));
  const Moving body(thing, standing({}));
  const GreyImage wanted = picture(all);
  const GreyImage image = picture(hall, {body.body()});
  const GreyImage empty = picture(hall);
  std::vector<int> off;
  int changed = 0;
  for (std::size_t i = 0; i < wanted.pixels().size(); ++i) {
    off.push_back(std::abs(image.pixels()[i] - wanted.pixels()[i]));
    changed += std::abs(image.pixels()[i] - empty.pixels()[i]) > 3 ? 1 : 0;
  }
  std::sort(off.begin(), off.end());
  EXPECT_GT(changed, 6000);
  const auto part = [&](double share) {
    return off[static_cast<std::size_t>(share * static_cast<double>(off.size() - 1))];
  };
  // Measured: 0, 3 and 9, in half shadows and along edges.
  EXPECT_LE(part(0.97), 1);
  EXPECT_LE(part(0.99), 4);
  EXPECT_LE(part(0.999), 12);
  EXPECT_LE(off.back(), 25);
}

// 0.6 m/s over 20 ms are 12 mm: more than a pixel.
TEST(RendererBodiesTest, MotionSmearsADotAlongItsWayAndLeavesItsMiddle) {
  const Hall hall(dark_floor(), {glow(1.2)});
  CameraView view(hall, overhead(), plain_sensor());
  const Vector3d velocity(0.6, 0.0, 0.0);
  const Vector3d at(0.1, 0.15, 0.5);
  const Model dotted{{plate(Vector3d::Zero(), 0.4, 0.4, kDark)}, {dot(Vector3d::Zero(), 0.06)}};
  const Moving standing_body(dotted, sliding(at, Vector3d::Zero()));
  const Moving moving_body(dotted, sliding(at - 2.0 * velocity, velocity));
  const Vector2d ahead = *overhead().project(at + Vector3d(0.05, 0.0, 0.0));
  const Vector2d behind = *overhead().project(at - Vector3d(0.05, 0.0, 0.0));
  const Vector2d along = (ahead - behind).normalized();
  const double scale_px_m = (ahead - behind).norm() / 0.1;
  const Exposure exposure{
      .middle_s = 2.0, .duration_s = 0.02, .opening = kReferenceExposure_s / 0.02};
  const auto moments = [&](const Moving& body) {
    const GreyImage image = picture(view, {body.body()}, {}, exposure);
    const Centre centre = measure(image, *overhead().project(at), 12);
    double square = 0.0;
    double sum = 0.0;
    for (int y = 0; y < image.height_px(); ++y) {
      for (int x = 0; x < image.width_px(); ++x) {
        if ((Vector2d(x, y) - centre.pixel).norm() > 16.0) continue;
        const double excess = image.at(x, y) - 15.0;
        square += excess * std::pow((Vector2d(x, y) - centre.pixel).dot(along), 2);
        sum += excess;
      }
    }
    return std::pair(centre, square / sum);
  };
  const auto [sharp, narrow] = moments(standing_body);
  const auto [smeared, wide] = moments(moving_body);
  EXPECT_LT((smeared.pixel - sharp.pixel).norm(), 0.01);
  const double length_px = 0.6 * 0.02 * scale_px_m;
  EXPECT_GT(length_px, 1.0);
  // A uniform smear adds length^2 / 12 to the variance along it; five instants of it, 4 % less.
  EXPECT_NEAR((wide - narrow) / (length_px * length_px / 12.0), 1.0, 0.15);
}

// An upright bar that moves to the right leans: each row is exposed a line time after the last.
TEST(RendererBodiesTest, ARollingShutterShearsWhatMoves) {
  const Vector3d eye(0.0, 0.0, 5.0);
  Lens lens;
  lens.centre_x_px = 159.5;
  lens.centre_y_px = 119.5;
  const SimCamera camera(eye, looking_at(eye, Vector3d::Zero(), 0.0, Vector3d::UnitY()), lens, 320,
                         240);
  SensorModel sensor = plain_sensor();
  sensor.line_time_s = 1e-4;
  const Hall hall(dark_floor(), {glow(1.2)});
  CameraView view(hall, camera, sensor);
  const Moving bar({{plate({0.0, 0.0, 0.5}, 0.06, 1.0, kWhite)}, {}},
                   sliding({-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
  const GreyImage image = picture(view, {bar.body()}, {}, {.middle_s = 1.0});
  const double scale_px_m = lens.focal_x_px / 4.5;
  const double sign = camera.project({0.1, 0.0, 0.5})->x() > 159.5 ? 1.0 : -1.0;
  for (const int row : {40, 80, 119, 160, 200}) {
    double sum = 0.0;
    double weighted = 0.0;
    for (int x = 0; x < image.width_px(); ++x) {
      sum += image.at(x, row) - 15.0;
      weighted += (image.at(x, row) - 15.0) * x;
    }
    const double wanted = 159.5 + sign * scale_px_m * (row - 119.5) * 1e-4;
    EXPECT_NEAR(weighted / sum, wanted, 0.05) << row;
  }
}

TEST(RendererBodiesTest, PicturesDoNotDependOnWhatWasRenderedBefore) {
  const Hall hall(furnished(), three_lamps());
  SensorModel sensor;
  const Moving one(contraption(), sliding({-0.5, 0.0, 0.0}, {0.4, 0.1, 0.0}));
  const Moving two(contraption(), sliding({0.5, -0.6, 0.0}, {-0.4, 0.2, 0.0}));
  const LightPlan plan{{{"a", 1.0, 0.3, 1.0}}};
  const std::vector<MovingBody> bodies = {one.body(), two.body()};
  CameraView forth(hall, overhead(), sensor);
  CameraView back(hall, overhead(), sensor);
  std::vector<GreyImage> forwards(4);
  for (std::size_t i = 0; i < forwards.size(); ++i) {
    forwards[i] = picture(forth, bodies, plan, {.middle_s = 0.5 * static_cast<double>(i)});
  }
  for (int i = 3; i >= 0; --i) {
    const GreyImage again = picture(back, bodies, plan, {.middle_s = 0.5 * i});
    EXPECT_EQ(again.pixels(), forwards[static_cast<std::size_t>(i)].pixels()) << i;
  }
  EXPECT_NE(forwards[0].pixels(), forwards[1].pixels());
}

}  // namespace
}  // namespace dottrack::host_sim
