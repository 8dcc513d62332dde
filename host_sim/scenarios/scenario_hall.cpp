// [hall], [vehicle] and places in the hall.

#include <fmt/format.h>

#include <cmath>

#include "host_sim/scenarios/scenario_reader.h"

namespace dottrack::host_sim {
namespace {

constexpr NumberRule kSide{3.0, 60.0, "a number of metres from 3 to 60", true};
constexpr IntegerRule kThings{0, 1000, "a whole number from 0 to 1000"};
constexpr IntegerRule kDots{3, 16, "a whole number from 3 to 16"};
constexpr IntegerRule kSeed{0, std::numeric_limits<std::int64_t>::max(),
                            "a whole number, 0 or more"};
constexpr NumberRule kCoordinate{-100.0, 100.0, "places [x, y] in metres"};

}  // namespace

Grounds read_hall(Complaint& complaint, const toml::table* table, std::uint64_t seed) {
  Grounds grounds;
  grounds.hall.seed = seed;
  if (table == nullptr) return grounds;
  TableReader reader(complaint, *table, "[hall]",
                     {"length_m", "width_m", "rocks", "look_alikes", "lander", "furniture",
                      "calibration_dots", "calibration_boxes"});
  HallOptions& hall = grounds.hall;
  hall.length_m = grounds.length_m = reader.number("length_m", grounds.length_m, kSide);
  hall.width_m = grounds.width_m = reader.number("width_m", grounds.width_m, kSide);
  hall.rocks = reader.integer("rocks", hall.rocks, kThings);
  hall.look_alikes = reader.integer("look_alikes", hall.look_alikes, kThings);
  hall.lander = reader.boolean("lander", hall.lander);
  hall.furniture = reader.boolean("furniture", hall.furniture);
  hall.calibration_dots = reader.integer("calibration_dots", hall.calibration_dots, kThings);
  hall.calibration_boxes = reader.integer("calibration_boxes", hall.calibration_boxes, kThings);
  return grounds;
}

bool on_grounds(const Grounds& grounds, const Eigen::Vector2d& p, double outside_m) {
  return std::abs(p.x()) <= 0.5 * grounds.length_m + outside_m &&
         std::abs(p.y()) <= 0.5 * grounds.width_m + outside_m;
}

void complain_outside(TableReader& reader, std::size_t line, const Eigen::Vector2d& p,
                      const Grounds& grounds, double outside_m) {
  reader.complain_at(
      line,
      fmt::format("[{}, {}] is outside the hall", config::shortest(p.x()), config::shortest(p.y())),
      fmt::format("|x| up to {} and |y| up to {} metres", 0.5 * grounds.length_m + outside_m,
                  0.5 * grounds.width_m + outside_m));
}

WayPoints read_way_points(TableReader& reader, std::string_view key, std::size_t at_least,
                          const Grounds& grounds, double outside_m) {
  WayPoints points;
  NumberRule rule = kCoordinate;
  const std::string expected = fmt::format("{} places [x, y] or more, in metres", at_least);
  rule.expected = expected;
  for (const NumberRow& row : reader.number_rows(key, 2, at_least, rule)) {
    const Eigen::Vector2d p(row.values[0], row.values[1]);
    if (!on_grounds(grounds, p, outside_m)) {
      complain_outside(reader, row.line, p, grounds, outside_m);
    } else if (!points.empty() && points.back() == p) {
      reader.complain_at(row.line, fmt::format("{} has one place twice in a row", key),
                         "places that differ");
    }
    points.push_back(p);
  }
  return points;
}

void check_turns(TableReader& reader, std::string_view key, const WayPoints& points, bool closed) {
  const std::size_t n = points.size();
  for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < n; ++i) {
    if (points[(i + n - 1) % n] != points[(i + 1) % n]) continue;
    reader.complain(key,
                    fmt::format("a way that turns on the spot at [{}, {}]",
                                config::shortest(points[i].x()), config::shortest(points[i].y())),
                    "a way round, or closed = false");
    return;
  }
}

VehicleChoice read_vehicle(Complaint& complaint, const toml::table* table,
                           std::optional<std::uint64_t> layout_seed) {
  static const toml::table kNothing;
  VehicleChoice choice;
  choice.target = demo_layout();
  TableReader reader(complaint, table != nullptr ? *table : kNothing, "[vehicle]",
                     {"kind", "dots", "layout_seed"});
  choice.kind = static_cast<VehicleKind>(reader.choice("kind", {"rover", "hanging", "none"}));
  const int dots = reader.integer("dots", 5, kDots);
  const auto in_file = static_cast<std::uint64_t>(reader.whole_number("layout_seed", 1, kSeed));
  if (dots != 5 || layout_seed || reader.has("layout_seed")) {
    choice.target = random_layout(dots, layout_seed.value_or(in_file));
  }
  return choice;
}

}  // namespace dottrack::host_sim
