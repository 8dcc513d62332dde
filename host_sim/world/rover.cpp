#include "host_sim/world/rover.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Pose at(const Vector3d& position_m) {
  return {position_m, Eigen::Matrix3d::Identity()};
}

Object box(const Vector3d& middle, const Vector3d& size, const Material& material) {
  return make_object(make_box(at(middle), size), material);
}

Object post(const Vector2d& foot, double bottom_m, double top_m, double radius_m,
            const Material& material) {
  return make_object(
      Cylinder{{foot.x(), foot.y(), bottom_m}, Vector3d::UnitZ(), top_m - bottom_m, radius_m},
      material);
}

Object flat(const std::vector<Vector2d>& outline, double height_m, const Material& material) {
  return make_object(
      make_outline({0.0, 0.0, height_m}, Vector3d::UnitX(), Vector3d::UnitY(), outline), material);
}

std::vector<Vector2d> grown(std::vector<Vector2d> outline, double factor) {
  for (Vector2d& v : outline) v *= factor;
  return outline;
}

void add_deck(std::vector<Object>& objects) {
  const Material cells{0.06, Pattern::cells, 0.25, 3};
  const Material rim{0.34, Pattern::plain, 0.0, 0};
  objects.push_back(flat(grown(deck_outline(), 1.022), kDeckHeight_m - 0.006, rim));
  objects.push_back(flat(deck_outline(), kDeckHeight_m, cells));
}

void add_body(std::vector<Object>& objects) {
  const Material foil{0.42, Pattern::mottled, 0.6, 5};
  const Material strut{0.22, Pattern::plain, 0.2, 0};
  objects.push_back(box({0.0, 0.0, 0.37}, {0.74, 0.56, 0.26}, foil));
  for (const double side : {-1.0, 1.0}) {
    objects.push_back(box({0.0, side * 0.46, 0.26}, {1.02, 0.05, 0.05}, strut));
  }
}

void add_wheels(std::vector<Object>& objects) {
  const Material tyre{0.13, Pattern::plain, 0.1, 0};
  const Material hub{0.34, Pattern::plain, 0.0, 0};
  for (const double x : {0.54, 0.0, -0.54}) {
    for (const double side : {-1.0, 1.0}) {
      const Vector3d inner(x, side * (kHalfTrack_m - 0.5 * kWheelWidth_m), 0.125);
      objects.push_back(make_object(Cylinder{inner, {0.0, side, 0.0}, kWheelWidth_m, 0.125}, tyre));
      objects.push_back(make_object(
          Disc{inner + Vector3d(0.0, side * (kWheelWidth_m + 0.003), 0.0), {0.0, side, 0.0}, 0.06},
          hub));
    }
  }
}

void add_mast(std::vector<Object>& objects) {
  const Material white{0.62, Pattern::plain, 0.2, 0};
  const Material lens{0.04, Pattern::plain, 0.5, 0};
  const Vector2d foot = deck_keepouts()[0].middle;
  objects.push_back(post(foot, kDeckHeight_m, 1.02, 0.028, white));
  objects.push_back(box({foot.x(), foot.y(), 1.06}, {0.09, 0.30, 0.09}, white));
  for (const double side : {-1.0, 1.0}) {
    objects.push_back(make_object(
        Disc{{foot.x() + 0.047, foot.y() + side * 0.11, 1.06}, Vector3d::UnitX(), 0.028}, lens));
  }
}

void add_antennas(std::vector<Object>& objects) {
  const Material grey{0.30, Pattern::plain, 0.1, 0};
  const Material dish{0.55, Pattern::plain, 0.1, 0};
  const Vector2d high_gain = deck_keepouts()[1].middle;
  const Vector2d low_gain = deck_keepouts()[2].middle;
  objects.push_back(post(high_gain, kDeckHeight_m, 0.70, 0.014, grey));
  const Vector3d tilt = Vector3d(-0.45, -0.30, 0.84).normalized();
  objects.push_back(make_object(Disc{{high_gain.x(), high_gain.y(), 0.71}, tilt, 0.115}, dish));
  objects.push_back(post(low_gain, kDeckHeight_m, 0.88, 0.020, grey));
}

void add_dots(std::vector<Object>& objects, const TargetLayout& dots) {
  for (const TargetDot& dot : dots) {
    objects.push_back(make_mark({dot.centre_m, dot.normal, 0.5 * dot.diameter_m}, 0.88));
  }
}

}  // namespace

const std::vector<Vector2d>& deck_outline() {
  static const std::vector<Vector2d> outline = {
      {0.66, 0.17},   {0.46, 0.40},   {0.32, 0.80},   {-0.16, 0.86}, {-0.33, 0.48}, {-0.74, 0.36},
      {-0.74, -0.36}, {-0.33, -0.48}, {-0.16, -0.86}, {0.32, -0.80}, {0.46, -0.40}, {0.66, -0.17}};
  return outline;
}

const std::vector<Keepout>& deck_keepouts() {
  static const std::vector<Keepout> keepouts = {
      {{0.44, 0.10}, 0.15}, {{-0.46, -0.20}, 0.22}, {{-0.62, 0.26}, 0.10}};
  return keepouts;
}

Vehicle make_rover(const TargetLayout& dots) {
  Vehicle rover;
  rover.dots = dots;
  rover.box_min_m = {-0.78, -0.90, 0.0};
  rover.box_max_m = {0.70, 0.90, 1.12};
  add_deck(rover.objects);
  add_body(rover.objects);
  add_wheels(rover.objects);
  add_mast(rover.objects);
  add_antennas(rover.objects);
  add_dots(rover.objects, dots);
  return rover;
}

}  // namespace dottrack::host_sim
