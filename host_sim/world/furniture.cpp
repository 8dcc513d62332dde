#include "host_sim/world/furniture.h"

#include "host_sim/world/look_alikes.h"
#include "host_sim/world/meshes.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

Cable rod(const Vector3d& from, const Vector3d& to, double radius_m) {
  Cable cable;
  for (const Vector3d& p : {from, to}) {
    cable.path.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()),
                            static_cast<float>(p.z()), static_cast<float>(radius_m));
  }
  return cable;
}

Material painted(RandomStream& random, double low, double high) {
  Material material;
  material.albedo = random.uniform(low, high);
  material.gloss = random.uniform(0.0, 0.25);
  return material;
}

const Material kSteel{0.5, Pattern::plain, 0.5};
const Material kBlack{0.06, Pattern::plain, 0.1};
const Material kPaper{0.85};

}  // namespace

Model make_cabinet(std::uint64_t seed) {
  RandomStream random(seed, 1);
  Model cabinet;
  const double height_m = random.uniform(1.0, 2.0);
  add(cabinet, box({0.0, 0.0, 0.5 * height_m}, {0.95, 0.46, height_m}),
      painted(random, 0.12, 0.62));
  add(cabinet, box({0.0, -0.231, 0.5 * height_m}, {0.012, 0.004, height_m - 0.1}), kBlack);
  for (const double x : {-0.07, 0.07}) {
    add(cabinet, box({x, -0.245, 0.55 * height_m}, {0.02, 0.03, 0.16}), kSteel);
  }
  add(cabinet, box({-0.28, -0.231, 0.8 * height_m}, {0.16, 0.004, 0.10}), kPaper);
  if (random.uniform() < 0.7) {
    const Pose on_top = upright({random.uniform(-0.2, 0.2), 0.0, height_m});
    append(cabinet, make_look_alike(random.word()), on_top);
  }
  return cabinet;
}

Model make_table(std::uint64_t seed) {
  RandomStream random(seed, 2);
  Model table;
  add(table, box({0.0, 0.0, 0.74}, {1.6, 0.7, 0.04}), painted(random, 0.2, 0.7));
  for (const double x : {-0.75, 0.75}) {
    for (const double y : {-0.3, 0.3}) {
      add(table, rod({x, y, 0.02}, {x, y, 0.72}, 0.02), kSteel);
    }
  }
  for (const double x : {-0.5, 0.0, 0.5}) {
    const double y = random.uniform(-0.15, 0.15);
    const Pose on_top = upright({x, y, 0.76}, random.uniform(0.0, kPi));
    const double what = random.uniform();
    if (what < 0.35) append(table, make_look_alike(random.word()), on_top);
    if (what > 0.55) {
      const Vector3d size{random.uniform(0.15, 0.45), random.uniform(0.1, 0.35),
                          random.uniform(0.01, 0.4)};
      add(table,
          box(Pose{on_top.position_m + Vector3d(0.0, 0.0, 0.5 * size.z()), on_top.rotation}, size),
          painted(random, 0.05, 0.85));
    }
  }
  return table;
}

Model make_chair(std::uint64_t seed) {
  RandomStream random(seed, 3);
  Model chair;
  const Material cloth = painted(random, 0.05, 0.4);
  add(chair, disc_plate({0.0, 0.0, 0.48}, Vector3d::UnitZ(), 0.23, 0.06), cloth);
  add(chair, box({0.0, 0.22, 0.78}, {0.40, 0.05, 0.34}), cloth);
  add(chair, rod({0.0, 0.20, 0.44}, {0.0, 0.25, 0.70}, 0.018), kSteel);
  add(chair, rod({0.0, 0.0, 0.08}, {0.0, 0.0, 0.44}, 0.025), kSteel);
  for (int leg = 0; leg < 5; ++leg) {
    const double angle = radians(72.0 * leg);
    const Vector3d foot(0.27 * cosine(angle), 0.27 * sine(angle), 0.04);
    add(chair, rod({0.0, 0.0, 0.09}, foot, 0.018), kBlack);
  }
  return chair;
}

Model make_tool_chest(std::uint64_t seed) {
  RandomStream random(seed, 4);
  Model chest;
  const double height_m = random.uniform(0.7, 1.1);
  add(chest, box({0.0, 0.0, 0.5 * (height_m + 0.1)}, {0.72, 0.46, height_m - 0.1}),
      painted(random, 0.10, 0.35));
  double z = 0.2;
  while (z < height_m - 0.1) {
    add(chest, box({0.0, -0.24, z + 0.09}, {0.60, 0.025, 0.018}), kSteel);
    add(chest, box({0.0, -0.231, z + 0.02}, {0.70, 0.004, 0.008}), kBlack);
    z += 0.14;
  }
  for (const double x : {-0.3, 0.3}) {
    for (const double y : {-0.18, 0.18}) {
      add(chest, cylinder({x - 0.015, y, 0.05}, Vector3d::UnitX(), 0.03, 0.05, 10), kBlack);
    }
  }
  if (random.uniform() < 0.5) {
    append(chest, make_look_alike(random.word()), upright({0.0, 0.0, height_m}));
  }
  return chest;
}

Model make_covered_heap(std::uint64_t seed) {
  RandomStream random(seed, 5);
  Model heap;
  const double height_m = random.uniform(0.45, 1.0);
  const Material plastic{random.uniform(0.6, 0.8), Pattern::plain, 0.8};
  for (int lump = 0; lump < 3; ++lump) {
    TriangleMesh mesh = rock(random.word(), 1.0);
    mesh.smooth = true;
    const Vector3d size{random.uniform(0.4, 0.6), random.uniform(0.3, 0.45),
                        random.uniform(0.7, 1.1) * height_m};
    for (Eigen::Vector3f& v : mesh.vertices) v = v.cwiseProduct(size.cast<float>());
    add(heap,
        transformed(std::move(mesh), upright({0.28 * (lump - 1), random.uniform(-0.1, 0.1), 0.0})),
        plastic);
  }
  return heap;
}

Model make_raised_floor(std::uint64_t seed) {
  RandomStream random(seed, 6);
  Model platform;
  const int missing = static_cast<int>(random.uniform() * 12.0);
  for (int tile = 0; tile < 12; ++tile) {
    const int column = tile % 4;
    const int row = tile / 4;
    const Vector3d middle(0.6 * column - 0.9, 0.6 * row - 0.6, 0.28);
    add(platform,
        stump({middle.x() - 0.3, middle.y() - 0.3, 0.0}, Vector3d::UnitZ(), 0.26, 0.05, 0.03, 8),
        kSteel);
    if (tile == missing) continue;
    Material material = painted(random, 0.38, 0.55);
    material.pattern = tile % 5 == 0 ? Pattern::mottled : Pattern::plain;
    add(platform, box(middle, {0.592, 0.592, 0.03}), material);
  }
  return platform;
}

Model make_hand_tool(std::uint64_t seed) {
  RandomStream random(seed, 7);
  Model tool;
  const double kind = random.uniform();
  if (kind < 0.35) {  // hammer
    add(tool, limb({-0.13, 0.0, 0.018}, {0.12, 0.0, 0.018}, 0.015, 0.012, 8),
        painted(random, 0.2, 0.6));
    add(tool, box({0.13, 0.0, 0.02}, {0.03, 0.11, 0.035}), kSteel);
  } else if (kind < 0.7) {  // spanner
    add(tool, box({0.0, 0.0, 0.008}, {0.20, 0.018, 0.010}), kSteel);
    add(tool, disc_plate({0.10, 0.0, 0.014}, Vector3d::UnitZ(), 0.026, 0.012, 12), kSteel);
    add(tool, disc_plate({-0.10, 0.0, 0.014}, Vector3d::UnitZ(), 0.022, 0.012, 12), kSteel);
  } else {  // roll of tape
    const double radius_m = random.uniform(0.04, 0.06);
    add(tool, disc_plate({0.0, 0.0, 0.05}, Vector3d::UnitZ(), radius_m, 0.05),
        painted(random, 0.4, 0.85));
    add(tool, disc_plate({0.0, 0.0, 0.052}, Vector3d::UnitZ(), 0.6 * radius_m, 0.01), kBlack);
  }
  return tool;
}

Model make_stand(std::uint64_t seed) {
  RandomStream random(seed, 8);
  Model stand;
  const double height_m = random.uniform(0.9, 1.7);
  for (int leg = 0; leg < 3; ++leg) {
    const double angle = radians(120.0 * leg);
    add(stand, rod({0.0, 0.0, 0.5}, {0.35 * cosine(angle), 0.35 * sine(angle), 0.01}, 0.012),
        kBlack);
  }
  add(stand, rod({0.0, 0.0, 0.4}, {0.0, 0.0, height_m}, 0.014), kBlack);
  if (random.uniform() < 0.5) {
    add(stand, box({0.0, 0.0, height_m}, {0.14, 0.18, 0.12}), painted(random, 0.1, 0.8));
    add(stand, disc_plate({0.0, -0.10, height_m}, -Vector3d::UnitY(), 0.045, 0.02), kPaper);
  } else {
    const Vector3d up = Vector3d(0.0, -0.6, 0.8);
    const double radius_m = random.uniform(0.04, 0.12);
    add(stand, disc_plate({0.0, 0.0, height_m + 0.03}, up, radius_m, 0.02),
        painted(random, 0.6, 0.88));
  }
  return stand;
}

Model make_bin(std::uint64_t seed) {
  RandomStream random(seed, 9);
  Model bin;
  const double kind = random.uniform();
  if (kind < 0.4) {
    const double radius_m = random.uniform(0.13, 0.18);
    add(bin, stump({0.0, 0.0, 0.0}, Vector3d::UnitZ(), 0.34, 0.85 * radius_m, radius_m, 28),
        painted(random, 0.3, 0.8));
    add(bin, disc_plate({0.0, 0.0, 0.342}, Vector3d::UnitZ(), 0.93 * radius_m, 0.01, 28),
        painted(random, 0.05, 0.8));
  } else if (kind < 0.7) {
    add(bin, cylinder({0.0, 0.0, 0.0}, Vector3d::UnitZ(), 0.85, 0.28, 32),
        painted(random, 0.1, 0.5));
    add(bin, disc_plate({0.12, 0.05, 0.865}, Vector3d::UnitZ(), 0.04, 0.02), kPaper);
  } else {
    add(bin, box({0.0, 0.0, 0.015}, {0.36, 0.36, 0.03}), kBlack);
    add(bin, stump({0.0, 0.0, 0.03}, Vector3d::UnitZ(), 0.60, 0.14, 0.03, 24),
        {0.75, Pattern::stripes, 0.1});
  }
  return bin;
}

}  // namespace dottrack::host_sim
