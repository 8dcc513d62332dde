#include "host_sim/scenarios/placements.h"

#include <algorithm>

#include "host_sim/world/look_alikes.h"
#include "host_sim/world/meshes.h"
#include "host_sim/world/motions.h"
#include "host_sim/world/person.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kToBoards_m = 1.1;    // of the vehicle's middle
constexpr double kFootprint_m = 0.8;   // half a side of what the vehicle covers
constexpr double kClearance_m = 0.22;  // it may stand over what is lower
constexpr double kAbove_m = 3.0;       // from where the ground is looked at
constexpr int kTries = 60;
constexpr double kNearest_m = 1.3;  // of clutter to the vehicle's middle
constexpr double kFarthest_m = 4.0;

double any_heading(RandomStream& random) {
  return random.uniform(-kPi, kPi);
}

Vector2d in_sandbox(const Scene& scene, RandomStream& random) {
  const double half_x = 0.5 * scene.length_m - kToBoards_m;
  const double half_y = 0.5 * scene.width_m - kToBoards_m;
  return Vector2d{random.uniform(-half_x, half_x), random.uniform(-half_y, half_y)};
}

// Looks down on a lattice of points of the footprint.
bool is_free(const RayScene& hall, const Terrain& terrain, const Vector2d& p) {
  constexpr int kSide = 7;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vector2d offset(i % kSide, i / kSide);
    const Vector2d q = p + kFootprint_m * (2.0 / (kSide - 1) * offset - Vector2d::Ones());
    const RayHit hit = hall.meet({q.x(), q.y(), kAbove_m}, -Vector3d::UnitZ(), kAbove_m + 1.0);
    const double top_m = hit.part < 0 ? 0.0 : kAbove_m - hit.distance;
    if (top_m > terrain.height_m(q) + kClearance_m) return false;
  }
  return true;
}

Vector2d free_place(const Scene& scene, const RayScene& hall, RandomStream& random) {
  Vector2d place = in_sandbox(scene, random);
  for (int i = 0; i < kTries && !is_free(hall, scene.terrain, place); ++i) {
    place = in_sandbox(scene, random);
  }
  return place;
}

Model make_crate(RandomStream& random) {
  const Vector3d size{random.uniform(0.3, 0.8), random.uniform(0.3, 0.6), random.uniform(0.2, 0.9)};
  Model crate;
  add(crate, box(Vector3d(0.0, 0.0, 0.5 * size.z()), size),
      {.albedo = random.uniform(0.1, 0.7), .pattern = Pattern::planks, .seed = random.word()});
  return crate;
}

class Surroundings {
 public:
  Surroundings(const Scene& scene, const Vector2d& middle, RandomStream& random)
      : scene_(scene), middle_(middle), random_(random) {}

  // Up to `most` things, somewhere around the vehicle but not under it.
  template <class Make>
  void add_up_to(int most, const char* name, std::vector<Body>& bodies, const Make& make) {
    const int count = static_cast<int>(random_.uniform() * (most + 1));
    for (int i = 0; i < count; ++i) {
      const Motion motion = stand_at(somewhere());
      bodies.push_back({name, make(random_), motion});
    }
  }

 private:
  Pose somewhere() {
    const double away_m = random_.uniform(kNearest_m, kFarthest_m);
    const double bearing = any_heading(random_);
    const Vector2d p = middle_ + away_m * Vector2d(cosine(bearing), sine(bearing));
    return upright({p.x(), p.y(), scene_.terrain.height_m(p)}, any_heading(random_));
  }

  const Scene& scene_;
  Vector2d middle_;
  RandomStream& random_;
};

// The light, and where irises settle in it: a white floor shall not fill the grey scale.
void set_random_light(RandomStream& random, Placement& placement) {
  constexpr double kSunShare = 0.3;
  constexpr double kFluorescentFloor = 0.6;  // radiance of a white floor at level 1
  constexpr double kSunFloor = 1.15;
  constexpr double kWanted = 0.6;
  const bool with_sun = random.uniform() < kSunShare;
  const double fluorescent = random.uniform(0.5, 1.0);
  const double window = random.uniform(0.1, 1.0);
  const double sun = (with_sun ? 1.0 : 0.0) * random.uniform(0.3, 1.0);
  const double floor = kFluorescentFloor * fluorescent + kSunFloor * sun;
  placement.light = {{{"fluorescent", 0.0, fluorescent, 0.0},
                      {"window", 0.0, window, 0.0},
                      {"sun", 0.0, sun, 0.0}}};
  placement.opening = std::min(1.0, kWanted / floor);
}

}  // namespace

Placement random_placement(const Scene& base, const RayScene& hall, std::uint64_t seed,
                           std::uint64_t index) {
  RandomStream random(mix(seed, 0x91ACE), index);
  Placement placement;
  const Vector2d place = free_place(base, hall, random);
  const Pose standing = placed_on(base.terrain, place, any_heading(random));
  if (base.vehicle) {
    placement.vehicle = standing;
    placement.bodies.push_back(
        {"vehicle", base.world.bodies[*base.vehicle].model, stand_at(standing)});
  }
  Surroundings around(base, place, random);
  around.add_up_to(6, "look-alike", placement.bodies,
                   [](RandomStream& r) { return make_look_alike(r.word()); });
  around.add_up_to(3, "person", placement.bodies,
                   [](RandomStream& r) { return make_person(r.word()); });
  around.add_up_to(2, "crate", placement.bodies, make_crate);
  set_random_light(random, placement);
  return placement;
}

}  // namespace dottrack::host_sim
