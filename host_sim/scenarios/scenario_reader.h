#pragma once
// What the readers of a scenario file's parts share. Not for others.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/config/table_reader.h"
#include "host_sim/scenarios/scene.h"
#include "host_sim/world/hall.h"
#include "host_sim/world/motions.h"
#include "host_sim/world/terrain.h"

namespace dottrack::host_sim {

using config::Complaint;
using config::IntegerRule;
using config::NumberRow;
using config::NumberRule;
using config::TableReader;

inline constexpr NumberRule kSeconds{0.0, 1e6, "a number of seconds, 0 or more", true};
inline constexpr NumberRule kShare{0.0, 1.0, "a number from 0 to 1", true};
inline constexpr NumberRule kSpeed{0.0, 10.0, "a number of metres a second above 0 and up to 10"};
inline constexpr NumberRule kAngle{-360.0, 360.0, "a number of degrees from -360 to 360", true};

inline constexpr double kOutsideBoards_m = 1.2;  // that people may walk on

// Whatever a reader finds wrong goes to the complaint; it then carries on with defaults.

struct Grounds {
  double length_m = 22.0;
  double width_m = 9.0;
  HallOptions hall;
};
Grounds read_hall(Complaint& complaint, const toml::table* table, std::uint64_t seed);

// The vehicle's place is checked against the sandbox, `outside_m` beyond its boards.
bool on_grounds(const Grounds& grounds, const Eigen::Vector2d& p, double outside_m = 0.0);
void complain_outside(TableReader& reader, std::size_t line, const Eigen::Vector2d& p,
                      const Grounds& grounds, double outside_m = 0.0);

// Rows of [x, y]. Complains of places outside and of two successive ones that are equal.
WayPoints read_way_points(TableReader& reader, std::string_view key, std::size_t at_least,
                          const Grounds& grounds, double outside_m = 0.0);

// Complains of a way that goes back where it came from: a smooth curve has no heading there.
void check_turns(TableReader& reader, std::string_view key, const WayPoints& points, bool closed);

enum class VehicleKind : std::uint8_t { rover, hanging, none };
struct VehicleChoice {
  VehicleKind kind = VehicleKind::rover;
  TargetLayout target;
};
VehicleChoice read_vehicle(Complaint& complaint, const toml::table* table,
                           std::optional<std::uint64_t> layout_seed);

struct Drive {
  std::optional<Ramp> ramp;
  // Made when the terrain is known, which the ramp is part of.
  std::function<Motion(const Terrain&)> motion;
  WayPoints way;            // where the vehicle's middle comes, close together
  std::vector<Span> spans;  // that count by themselves
  std::size_t line = 1;
};
Drive read_motion(Complaint& complaint, const toml::table* table, const Grounds& grounds,
                  std::uint64_t seed);

// [light] and [[light_change]].
LightPlan read_light(Complaint& complaint, const toml::table* levels,
                     const std::vector<const toml::table*>& changes);

// [[person]], [[look_alike]] and [[cover]]; the vehicle's motion for what it carries.
void read_bodies(Complaint& complaint, TableReader& root, const Grounds& grounds,
                 const Terrain& terrain, const Motion& vehicle, std::uint64_t seed,
                 std::vector<Body>& bodies);

// [cameras], [[camera]] and [sensor].
std::vector<SceneCamera> read_cameras(Complaint& complaint, TableReader& root,
                                      const Grounds& grounds, std::uint64_t seed);

// [grabber], [[camera_fault]], [iris], [can] and [[can.bus_off]], after the cameras.
void read_hardware(Complaint& complaint, TableReader& root, Scene& scene);

// [dots].
DotAppearance read_appearance(Complaint& complaint, const toml::table* table);

}  // namespace dottrack::host_sim
