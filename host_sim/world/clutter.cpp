#include "host_sim/world/clutter.h"

#include <algorithm>
#include <cmath>

#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kVehicleReach_m = 1.02;  // half the vehicle's diagonal
constexpr int kAttempts = 60;             // to find room for one thing

Eigen::Matrix3d turned(double yaw_rad) {
  const double c = cosine(yaw_rad);
  const double s = sine(yaw_rad);
  Eigen::Matrix3d rotation;
  rotation << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return rotation;
}

// Places that are taken already.
class Floor {
 public:
  explicit Floor(const ClutterOptions& options) : options_(options) {}

  // A free place for something of this radius; false when none was found.
  bool find(RandomStream& random, double radius_m, double clear_of_drive_m, Vector2d& place) {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      place = {random.uniform(-1.0, 1.0) * (options_.half_length_m - radius_m - 0.1),
               random.uniform(-1.0, 1.0) * (options_.half_width_m - radius_m - 0.1)};
      if (!is_free(place, radius_m, clear_of_drive_m)) continue;
      taken_.push_back({place, radius_m});
      return true;
    }
    return false;
  }

 private:
  struct Circle {
    Vector2d middle;
    double radius_m;
  };

  bool is_free(const Vector2d& place, double radius_m, double clear_of_drive_m) const {
    if (options_.distance_to_drive_m && options_.distance_to_drive_m(place) < clear_of_drive_m) {
      return false;
    }
    return std::none_of(taken_.begin(), taken_.end(), [&](const Circle& c) {
      return (c.middle - place).norm() < c.radius_m + radius_m + 0.05;
    });
  }

  const ClutterOptions& options_;
  std::vector<Circle> taken_;
};

Vector3d random_direction(RandomStream& random) {
  for (;;) {
    const Vector3d v{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                     random.uniform(-1.0, 1.0)};
    if (v.squaredNorm() > 0.01 && v.squaredNorm() < 1.0) return v.normalized();
  }
}

// A ball cut by random planes, flattened and half buried.
Object make_rock(RandomStream& random, const Vector2d& place, double radius_m) {
  Convex rock;
  const Vector3d middle(place.x(), place.y(), 0.25 * radius_m);
  rock.bound = {middle, 1.8 * radius_m};
  const auto add_face = [&](const Vector3d& normal, double reach_m) {
    rock.faces.push_back({normal, normal.dot(middle) + reach_m});
  };
  for (int axis = 0; axis < 3; ++axis) {
    add_face(Vector3d::Unit(axis), radius_m * (axis == 2 ? 0.62 : 1.0));
    add_face(-Vector3d::Unit(axis), radius_m);
  }
  for (int i = 0; i < 16; ++i) {
    const Vector3d normal = random_direction(random);
    add_face(normal, radius_m * random.uniform(0.62, 0.92) * (1.0 - 0.3 * std::abs(normal.z())));
  }
  return make_object(rock, {random.uniform(0.16, 0.32), Pattern::mottled, 0.0, random.word()});
}

void add_rocks(const ClutterOptions& options, Floor& floor, std::vector<Object>& objects) {
  RandomStream random(options.seed, 2);
  for (int i = 0; i < options.rocks; ++i) {
    const double size = random.uniform();
    const double radius_m = 0.05 + 0.27 * size * size * size;
    Vector2d place;
    if (!floor.find(random, radius_m, kVehicleReach_m + radius_m, place)) continue;
    objects.push_back(make_rock(random, place, radius_m));
  }
}

void add_box(RandomStream& random, const Vector2d& place, std::vector<Object>& objects) {
  const Vector3d size{random.uniform(0.25, 0.55), random.uniform(0.2, 0.4),
                      random.uniform(0.15, 0.45)};
  const Eigen::Matrix3d rotation = turned(random.uniform(0.0, kPi));
  const Pattern pattern = random.uniform() < 0.25 ? Pattern::stripes : Pattern::plain;
  objects.push_back(make_object(make_box({{place.x(), place.y(), 0.5 * size.z()}, rotation}, size),
                                {random.uniform(0.15, 0.75), pattern, 0.15, random.word()}));
  if (random.uniform() < 0.7) {  // a label or a lid's knob, as bright and as big as a dot
    const Vector3d on_top(place.x(), place.y(), size.z() + 0.002);
    objects.push_back(make_mark({on_top, Vector3d::UnitZ(), random.uniform(0.03, 0.055)}, 0.85));
  }
}

void add_boxes(const ClutterOptions& options, Floor& floor, std::vector<Object>& objects) {
  RandomStream random(options.seed, 3);
  for (int i = 0; i < options.boxes; ++i) {
    Vector2d place;
    if (!floor.find(random, 0.35, kVehicleReach_m + 0.35, place)) continue;
    add_box(random, place, objects);
  }
}

void add_look_alikes(const ClutterOptions& options, Floor& floor, std::vector<Object>& objects) {
  RandomStream random(options.seed, 4);
  for (int i = 0; i < options.look_alikes; ++i) {
    Vector2d place;
    if (!floor.find(random, 0.10, -1.0, place)) continue;
    const Disc disc{{place.x(), place.y(), 0.004}, Vector3d::UnitZ(), random.uniform(0.035, 0.065)};
    objects.push_back(make_mark(disc, random.uniform(0.70, 0.90)));
  }
}

// A row of boards, each short, from `middle` to both sides along x or y.
void add_boards(const Vector3d& middle, int axis, double length_m, std::vector<Object>& objects) {
  const int pieces = static_cast<int>(std::ceil(length_m));
  const double piece_m = length_m / pieces;
  Vector3d size(0.06, 0.06, 0.2);
  size[axis] = piece_m;
  for (int i = 0; i < pieces; ++i) {
    const Vector3d at = middle + ((i + 0.5) * piece_m - 0.5 * length_m) * Vector3d::Unit(axis);
    objects.push_back(make_object(make_box({at, Eigen::Matrix3d::Identity()}, size),
                                  {0.34, Pattern::planks, 0.0, 9}));
  }
}

Object wall(const Vector3d& foot, const Vector3d& along, double half_length_m) {
  const std::vector<Vector2d> outline = {
      {-half_length_m, 0.0}, {half_length_m, 0.0}, {half_length_m, 6.0}, {-half_length_m, 6.0}};
  Object object = make_object(make_outline(foot, along, Vector3d::UnitZ(), outline),
                              {0.40, Pattern::plain, 0.0, 0});
  object.obstructs = false;  // the key lamp shines in through a window
  return object;
}

}  // namespace

std::vector<Object> make_clutter(const ClutterOptions& options) {
  std::vector<Object> objects;
  Floor floor(options);
  add_boxes(options, floor, objects);
  add_rocks(options, floor, objects);
  add_look_alikes(options, floor, objects);
  return objects;
}

std::vector<Object> make_hall(double half_length_m, double half_width_m) {
  const double x = half_length_m + 0.03;
  const double y = half_width_m + 0.03;
  const double wall_x = half_length_m + 1.8;
  const double wall_y = half_width_m + 1.8;
  std::vector<Object> objects = {wall({wall_x, 0.0, 0.0}, Vector3d::UnitY(), wall_y),
                                 wall({-wall_x, 0.0, 0.0}, Vector3d::UnitY(), wall_y),
                                 wall({0.0, wall_y, 0.0}, Vector3d::UnitX(), wall_x),
                                 wall({0.0, -wall_y, 0.0}, Vector3d::UnitX(), wall_x)};
  for (const double side : {-1.0, 1.0}) {
    add_boards({0.0, side * y, 0.1}, 0, 2.0 * x + 0.06, objects);
    add_boards({side * x, 0.0, 0.1}, 1, 2.0 * y - 0.06, objects);
  }
  return objects;
}

}  // namespace dottrack::host_sim
