#include "host_sim/world/person.h"

#include <array>

#include "host_sim/world/meshes.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

constexpr std::array<double, 5> kShirts = {0.72, 0.15, 0.45, 0.30, 0.85};
constexpr std::array<double, 4> kTrousers = {0.08, 0.16, 0.22, 0.35};
constexpr std::array<double, 4> kHair = {0.04, 0.10, 0.28, 0.5};

template <std::size_t N>
double one_of(const std::array<double, N>& values, RandomStream& random) {
  return values[static_cast<std::size_t>(random.uniform() * static_cast<double>(N))];
}

void add_legs(Model& model, RandomStream& random) {
  const Material cloth{one_of(kTrousers, random)};
  const Material shoe{random.uniform() < 0.3 ? 0.7 : 0.08, Pattern::plain, 0.1};
  for (const double y : {-0.10, 0.10}) {
    const double stride = y > 0.0 ? 0.09 : -0.07;
    const Vector3d ankle(stride, y, 0.09);
    const Vector3d knee(0.5 * stride + 0.03, y, 0.48);
    add(model, limb(knee, {0.0, 0.9 * y, 0.90}, 0.062, 0.085), cloth);
    add(model, limb(ankle, knee, 0.045, 0.060), cloth);
    add(model, ellipsoid(upright({stride + 0.05, y, 0.045}), {0.135, 0.05, 0.045}, 8), shoe);
  }
}

// Where the right hand is.
Vector3d add_trunk_and_arms(Model& model, RandomStream& random) {
  const Material shirt{one_of(kShirts, random)};
  const Material skin{random.uniform(0.25, 0.5), Pattern::plain, 0.05};
  add(model, ellipsoid(upright({0.0, 0.0, 1.18}), {0.13, 0.19, 0.34}), shirt);
  add(model, ellipsoid(upright({0.0, 0.0, 1.40}), {0.10, 0.21, 0.10}), shirt);
  Vector3d right_hand = Vector3d::Zero();
  for (const double y : {-0.23, 0.23}) {
    const double swing = y > 0.0 ? -0.06 : 0.16;
    const Vector3d shoulder(0.0, y, 1.41);
    const Vector3d elbow(0.3 * swing, 1.12 * y, 1.14);
    const Vector3d hand = elbow + Vector3d(0.18 + 0.3 * swing, 0.0, -0.13);
    add(model, limb(shoulder, elbow, 0.056, 0.045), shirt);
    add(model, limb(elbow, hand, 0.040, 0.034), skin);
    if (y < 0.0) right_hand = hand;
  }
  add(model, limb({0.0, 0.0, 1.44}, {0.01, 0.0, 1.56}, 0.055, 0.055), skin);
  add(model, ellipsoid(upright({0.02, 0.0, 1.635}), {0.095, 0.075, 0.115}), skin);
  return right_hand;
}

void add_hair_or_helmet(Model& model, bool helmet, RandomStream& random) {
  if (!helmet) {
    const Material hair{one_of(kHair, random)};
    add(model, ellipsoid(upright({-0.012, 0.0, 1.665}), {0.10, 0.083, 0.095}), hair);
    return;
  }
  const Material white{0.85, Pattern::plain, 0.35};
  add(model, ellipsoid(upright({0.005, 0.0, 1.68}), {0.135, 0.11, 0.09}), white);
  add(model, ellipsoid(upright({0.05, 0.0, 1.665}), {0.15, 0.115, 0.012}), white);
}

void add_cup(Model& model, const Vector3d& hand) {
  const Vector3d foot = hand + Vector3d(0.05, 0.0, -0.02);
  add(model, stump(foot, Vector3d::UnitZ(), 0.10, 0.032, 0.042), {0.88});
}

}  // namespace

Model make_person(std::uint64_t seed) {
  RandomStream random(seed, 0x9E5);
  Model person;
  const double extra = random.uniform();
  add_legs(person, random);
  const Vector3d hand = add_trunk_and_arms(person, random);
  add_hair_or_helmet(person, extra < 0.4, random);
  if (extra > 0.7) add_cup(person, hand);
  return person;
}

}  // namespace dottrack::host_sim
