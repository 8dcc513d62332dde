#include "host_sim/world/look_alikes.h"

#include "host_sim/world/meshes.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

// A dot's radius, more or less.
double disc_radius_m(RandomStream& random) {
  return random.uniform(0.035, 0.065);
}

void paint(Model& model, std::size_t part, const Vector3d& face_m, RandomStream& random) {
  Mark mark;
  mark.centre_m = face_m;
  mark.normal = Vector3d::UnitZ();
  mark.radius_m = disc_radius_m(random);
  mark.albedo = random.uniform(0.70, 0.90);
  mark.part = part;
  model.marks.push_back(mark);
}

void add_plate(Model& model, RandomStream& random) {
  const double height_m = random.uniform(0.01, 0.04);
  const Vector3d size{random.uniform(0.16, 0.30), random.uniform(0.16, 0.30), height_m + 0.10};
  const Pose middle = upright({0.0, 0.0, height_m - 0.5 * size.z()});
  const Material dark{random.uniform(0.05, 0.25), Pattern::plain, 0.1};
  paint(model, add(model, box(middle, size), dark), {0.0, 0.0, height_m}, random);
}

void add_ball(Model& model, RandomStream& random) {
  const double radius_m = disc_radius_m(random);
  Balls ball;
  ball.balls.emplace_back(0.0F, 0.0F, static_cast<float>(0.9 * radius_m),
                          static_cast<float>(radius_m));
  add(model, ball, {random.uniform(0.6, 0.9), Pattern::plain, random.uniform(0.0, 0.4)});
}

void add_cup(Model& model, RandomStream& random) {
  const double radius_m = 0.9 * disc_radius_m(random);
  add(model, stump({0.0, 0.0, -0.02}, Vector3d::UnitZ(), 0.13, 0.8 * radius_m, radius_m, 20),
      {random.uniform(0.7, 0.9), Pattern::plain, 0.1});
}

void add_lid(Model& model, RandomStream& random) {
  const double radius_m = disc_radius_m(random);
  const Vector3d tilt = Vector3d{random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15), 1.0};
  add(model, disc_plate({0.0, 0.0, 0.015}, tilt.normalized(), radius_m, 0.035),
      {random.uniform(0.65, 0.9), Pattern::plain, random.uniform(0.0, 0.5)});
}

void add_box(Model& model, RandomStream& random) {
  const Vector3d size{random.uniform(0.25, 0.50), random.uniform(0.2, 0.38),
                      random.uniform(0.15, 0.45)};
  const Pattern pattern = random.uniform() < 0.25 ? Pattern::stripes : Pattern::plain;
  const Material card{random.uniform(0.12, 0.55), pattern, 0.15, random.word()};
  const Vector3d sunk(0.0, 0.0, 0.5 * size.z() - 0.05);
  const std::size_t part = add(model, box(sunk, size + Vector3d(0.0, 0.0, 0.1)), card);
  const double top_m = size.z();
  if (random.uniform() < 0.6) {
    paint(model, part, {0.0, 0.0, top_m}, random);
    return;
  }
  const Vector3d label{random.uniform(0.06, 0.15), random.uniform(0.05, 0.12), 0.002};
  add(model, box({0.03, 0.02, top_m + 0.001}, label), {0.85});
}

void add_stone(Model& model, RandomStream& random) {
  const double radius_m = random.uniform(0.06, 0.16);
  const Material stone{random.uniform(0.15, 0.45), Pattern::mottled, 0.0, random.word()};
  add(model, transformed(rock(random.word(), radius_m), upright({0.0, 0.0, 0.2 * radius_m})),
      stone);
}

}  // namespace

Model make_look_alike(std::uint64_t seed) {
  RandomStream random(seed, 0x100C);
  Model thing;
  const double kind = random.uniform();
  const double yaw_rad = random.uniform(0.0, 2.0 * kPi);
  if (kind < 0.40) {
    add_plate(thing, random);
  } else if (kind < 0.52) {
    add_ball(thing, random);
  } else if (kind < 0.64) {
    add_cup(thing, random);
  } else if (kind < 0.76) {
    add_lid(thing, random);
  } else if (kind < 0.92) {
    add_box(thing, random);
  } else {
    add_stone(thing, random);
  }
  Model turned;
  append(turned, thing, upright(Vector3d::Zero(), yaw_rad));
  return turned;
}

}  // namespace dottrack::host_sim
