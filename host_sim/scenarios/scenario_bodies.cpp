// [[person]], [[look_alike]] and [[cover]]: what else moves, or could.

#include <fmt/format.h>

#include "host_sim/scenarios/scenario_reader.h"
#include "host_sim/world/look_alikes.h"
#include "host_sim/world/meshes.h"
#include "host_sim/world/person.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"
#include "host_sim/world/rover.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr NumberRule kOver{-2.0, 2.0, "two numbers of metres from -2 to 2, in vehicle coordinates"};
constexpr NumberRule kCoverSize{0.0, 3.0, "two numbers of metres above 0 and up to 3"};
constexpr NumberRule kHeight{0.0, 2.0, "a number of metres above 0 and up to 2"};
constexpr NumberRule kPlace{-100.0, 100.0, "a place [x, y] in metres"};

Pose standing(const Terrain& terrain, const Vector2d& at, double yaw_rad) {
  return upright({at.x(), at.y(), terrain.height_m(at)}, yaw_rad);
}

Body read_person(Complaint& complaint, const toml::table& table, const Grounds& grounds,
                 const Terrain& terrain, std::uint64_t seed) {
  TableReader reader(complaint, table, "[[person]]", {"way_points", "speed_m_s", "closed"});
  const WayPoints points = read_way_points(reader, "way_points", 1, grounds, kOutsideBoards_m);
  const double speed = reader.number("speed_m_s", 1.0, kSpeed);
  const bool closed = reader.boolean("closed", true);
  if (points.size() > 1) check_turns(reader, "way_points", points, closed);
  Body body{"person", make_person(seed), {}};
  if (points.size() == 1) {
    const double yaw = RandomStream(seed, 0xFACE).uniform(-kPi, kPi);
    body.motion = stand_at(standing(terrain, points.front(), yaw));
  } else if (complaint.empty()) {
    body.motion = walk(terrain, points, speed, closed);
  }
  return body;
}

Body read_look_alike(Complaint& complaint, const toml::table& table, const Grounds& grounds,
                     const Terrain& terrain, std::uint64_t seed) {
  TableReader reader(complaint, table, "[[look_alike]]", {"at", "yaw_deg"});
  const std::vector<double> v = reader.numbers("at", 2, std::nullopt, kPlace);
  const Vector2d at(v[0], v[1]);
  if (!on_grounds(grounds, at, kOutsideBoards_m)) {
    complain_outside(reader, reader.line("at"), at, grounds, kOutsideBoards_m);
  }
  const double yaw = radians(reader.number("yaw_deg", 0.0, kAngle));
  return {"look-alike", make_look_alike(seed), stand_at(standing(terrain, at, yaw))};
}

// A plate that lies over a part of the vehicle for a while.
Body read_cover(Complaint& complaint, const toml::table& table, const Motion& vehicle) {
  TableReader reader(complaint, table, "[[cover]]",
                     {"over_m", "size_m", "above_deck_m", "from_s", "to_s"});
  const std::vector<double> over = reader.numbers("over_m", 2, {{0.0, 0.0}}, kOver);
  const std::vector<double> size = reader.numbers("size_m", 2, std::nullopt, kCoverSize);
  const double above = reader.number("above_deck_m", 0.12, kHeight);
  const double from = reader.number("from_s", 0.0, kSeconds);
  const double to = reader.number("to_s", std::nullopt, kSeconds);
  if (!(from < to)) reader.complain("to_s", config::shortest(to), "a time after from_s");
  if (!vehicle) complaint.add(reader.line(), "[[cover]] without a vehicle", "a vehicle to cover");
  constexpr double kThickness_m = 0.01;
  Body body{"cover", {}, {}};
  add(body.model,
      box(Vector3d(over[0], over[1], kDeckHeight_m + above),
          Vector3d(size[0], size[1], kThickness_m)),
      {.albedo = 0.55});
  body.motion = switched({{from, vehicle}, {to, Motion{}}});
  return body;
}

}  // namespace

void read_bodies(Complaint& complaint, TableReader& root, const Grounds& grounds,
                 const Terrain& terrain, const Motion& vehicle, std::uint64_t seed,
                 std::vector<Body>& bodies) {
  std::uint64_t next = 0;
  for (const toml::table* table : root.tables("person")) {
    bodies.push_back(read_person(complaint, *table, grounds, terrain, mix(seed, 0x9E0 + next++)));
  }
  next = 0;
  for (const toml::table* table : root.tables("look_alike")) {
    bodies.push_back(
        read_look_alike(complaint, *table, grounds, terrain, mix(seed, 0x100A + next++)));
  }
  for (const toml::table* table : root.tables("cover")) {
    bodies.push_back(read_cover(complaint, *table, vehicle));
  }
}

}  // namespace dottrack::host_sim
