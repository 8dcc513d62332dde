#include "host_sim/scenarios/ceiling.h"

#include <cmath>

#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kOutside_m = 0.9;   // of the boards
constexpr double kAlongSide = 0.96;  // of the half side: how far out the cameras stand
constexpr double kFisheyeLinearity = 0.4;

struct Spot {
  Vector2d at_m;
  Vector2d aim_m;
};

// The shares of the sandbox's half sides below are where 12 cameras of 70 degrees see every place
// of it at least three times, and most of it five times.

// On a long side, `i` of `count`. `side`: 1 or -1. Looks steeply down on the nearer half: what is
// right below is seen from the other side.
Spot on_side(const CeilingOptions& options, int i, int count, double side) {
  const double along = count > 1 ? 2.0 * i / (count - 1) - 1.0 : 0.0;
  // The square root makes them denser towards the ends, which fewer others look at.
  const double share = kAlongSide * std::copysign(std::sqrt(std::abs(along)), along);
  const double x = 0.5 * options.length_m * share;
  const double y = side * (0.5 * options.width_m + kOutside_m);
  return {{x, y}, {0.9 * x, side * 0.12 * options.width_m}};
}

Spot at_end(const CeilingOptions& options, double side) {
  const double half_m = 0.5 * options.length_m;
  return {{side * (half_m + kOutside_m), 0.0}, {side * 0.67 * half_m, 0.0}};
}

std::vector<Spot> spots(const CeilingOptions& options) {
  std::vector<Spot> all;
  all.reserve(static_cast<std::size_t>(options.cameras));
  const int at_ends = options.cameras >= 6 ? 2 : 0;
  const int left = (options.cameras - at_ends + 1) / 2;
  const int right = options.cameras - at_ends - left;
  for (int i = 0; i < left; ++i) all.push_back(on_side(options, i, left, 1.0));
  for (int i = 0; i < right; ++i) all.push_back(on_side(options, i, right, -1.0));
  for (int i = 0; i < at_ends; ++i) all.push_back(at_end(options, i == 0 ? 1.0 : -1.0));
  return all;
}

double c_of(const Lens& lens, double angle_rad) {
  if (lens.kind != LensKind::fisheye) return tangent(angle_rad);
  return tangent(lens.linearity * angle_rad) / lens.linearity;
}

Lens make_lens(const CeilingOptions& options, RandomStream& random) {
  Lens lens;
  lens.kind = options.lens;
  if (lens.kind == LensKind::fisheye) lens.linearity = kFisheyeLinearity;
  const double field_rad = radians(random.uniform(options.field_min_deg, options.field_max_deg));
  lens.focal_x_px = 0.5 * options.width_px / c_of(lens, 0.5 * field_rad);
  lens.focal_y_px = lens.focal_x_px * random.uniform(0.998, 1.002);
  lens.centre_x_px = 0.5 * (options.width_px - 1) + random.uniform(-0.01, 0.01) * options.width_px;
  lens.centre_y_px = 0.5 * (options.height_px - 1) + random.uniform(-0.01, 0.01) * options.width_px;
  if (lens.kind == LensKind::pinhole) return lens;
  lens.axis = Vector3d{random.uniform(-0.008, 0.008), random.uniform(-0.008, 0.008), 1.0};
  if (lens.kind == LensKind::radial) {
    lens.radial = {random.uniform(-0.001, 0.001), random.uniform(-0.16, -0.08),
                   random.uniform(0.015, 0.03)};
  } else {
    lens.radial = {random.uniform(-0.001, 0.001), random.uniform(-0.02, 0.0),
                   random.uniform(0.0, 0.002)};
    lens.pupil_m = {random.uniform(0.002, 0.004), random.uniform(0.0, 0.002), 0.0};
  }
  return lens;
}

}  // namespace

std::vector<CameraPlace> ceiling_places(const CeilingOptions& options) {
  std::vector<CameraPlace> places;
  for (const Spot& spot : spots(options)) {
    RandomStream random(options.seed, 0xCA0 + places.size());
    const Vector3d at{spot.at_m.x() + random.uniform(-0.15, 0.15),
                      spot.at_m.y() + random.uniform(-0.15, 0.15),
                      options.height_m + random.uniform(-0.2, 0.2)};
    const Vector3d aim{spot.aim_m.x() + random.uniform(-0.2, 0.2),
                       spot.aim_m.y() + random.uniform(-0.2, 0.2), 0.3};
    places.push_back({at, aim, radians(random.uniform(-3.0, 3.0))});
  }
  return places;
}

SimCamera ceiling_camera(const CeilingOptions& options, std::size_t index,
                         const CameraPlace& place) {
  RandomStream random(options.seed, 0x1E45 + index);
  const Lens lens = make_lens(options, random);
  const Vector3d sight = (place.aim_m - place.at_m).normalized();
  const bool straight_down = sight.head<2>().norm() < 1e-3;
  const Vector3d up = straight_down ? Vector3d::UnitX() : Vector3d::UnitZ();
  return {place.at_m, looking_at(place.at_m, place.aim_m, place.roll_rad, up), lens,
          options.width_px, options.height_px};
}

}  // namespace dottrack::host_sim
