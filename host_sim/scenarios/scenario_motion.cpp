// [motion]: how the vehicle moves.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "host_sim/scenarios/scenario_reader.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr NumberRule kPlace{-100.0, 100.0, "a place [x, y] in metres"};
constexpr NumberRule kPlaceAndTime{-1e6, 1e6,
                                   "one row [from_s, x_m, y_m, yaw_deg] or more, times ascending"};
constexpr NumberRule kLine{-100.0, 100.0, "one row [x0, y0, z0, x1, y1, z1] or more, in metres"};
constexpr NumberRule kVibration{0.0, 0.1, "a number of metres from 0 to 0.1", true};
constexpr NumberRule kMargin{0.0, 10.0, "a number of metres from 0 to 10", true};
constexpr NumberRule kSlope{0.0, 40.0, "a number of degrees above 0 and up to 40"};
constexpr NumberRule kRampLength{1.0, 20.0, "a number of metres from 1 to 20", true};
constexpr NumberRule kRampWidth{1.2, 10.0, "a number of metres from 1.2 to 10", true};
constexpr NumberRule kDwell{0.0, 1e4, "a number of seconds above 0 and up to 10000"};
constexpr NumberRule kSpeedOrStill{0.0, 10.0, "a number of metres a second from 0 to 10", true};
constexpr IntegerRule kPlaces{1, 1000, "a whole number from 1 to 1000"};

constexpr double kBeforeRamp_m = 2.0;  // where the drive up begins
constexpr double kStep_m = 0.25;       // between the places of a way

Vector2d ahead(double yaw_rad) {
  return {cosine(yaw_rad), sine(yaw_rad)};
}

// The vehicle's middle along the motion, as far as `until_s`.
WayPoints way_of(const Motion& motion, double until_s) {
  constexpr int kSamples = 600;
  WayPoints way;
  for (int i = 0; i <= kSamples; ++i) {
    const auto pose = motion(until_s * i / kSamples);
    if (!pose) continue;
    const Vector2d p = pose->position_m.head<2>();
    if (way.empty() || (way.back() - p).norm() > 0.5 * kStep_m) way.push_back(p);
  }
  return way;
}

class MotionReader {
 public:
  MotionReader(TableReader& reader, const Grounds& grounds, std::uint64_t seed)
      : reader_(reader), grounds_(grounds), seed_(seed) {}

  Drive drive() {
    const WayPoints points = read_way_points(reader_, "way_points", 2, grounds_);
    const double speed = reader_.number("speed_m_s", 0.3, kSpeed);
    const bool closed = reader_.boolean("closed", true);
    if (points.size() < 2) return {};
    check_turns(reader_, "way_points", points, closed);
    return made_of(
        [=](const Terrain& terrain) { return drive_along(terrain, points, speed, closed); },
        path_length_m(points, closed) / speed);
  }

  Drive stand() {
    const Vector2d at = place("at");
    const double yaw = radians(reader_.number("yaw_deg", 0.0, kAngle));
    return made_of([=](const Terrain& terrain) { return stand_at(placed_on(terrain, at, yaw)); },
                   0.0);
  }

  Drive leave_and_return() {
    Drive drive_all = drive();
    const double gone = reader_.number("gone_s", std::nullopt, kSeconds);
    const double back = reader_.number("back_s", std::nullopt, kSeconds);
    if (!(gone < back)) {
      reader_.complain("back_s", config::shortest(back), "a time after gone_s");
    }
    if (!drive_all.motion) return drive_all;
    drive_all.motion = [=, all = drive_all.motion](const Terrain& terrain) {
      const Motion motion = all(terrain);
      return switched({{0.0, motion}, {gone, Motion{}}, {back, motion}});
    };
    return drive_all;
  }

  // Each row: from when on it is where, heading which way; it goes straight on from there.
  Drive kidnap() {
    struct Stay {
      double from_s;
      Vector2d at;
      double yaw_rad;
    };
    std::vector<Stay> stays;
    const double speed = reader_.number("speed_m_s", 0.0, kSpeedOrStill);
    double last_s = -1.0;
    for (const NumberRow& row : reader_.number_rows("places", 4, 1, kPlaceAndTime)) {
      const Vector2d at(row.values[1], row.values[2]);
      if (!on_grounds(grounds_, at)) complain_outside(reader_, row.line, at, grounds_);
      if (row.values[0] <= last_s || row.values[0] < 0.0) {
        reader_.complain_at(row.line,
                            fmt::format("places has from_s {}", config::shortest(row.values[0])),
                            "times from 0 on, ascending");
      }
      last_s = row.values[0];
      stays.push_back({last_s, at, radians(row.values[3])});
    }
    return made_of(
        [=](const Terrain& terrain) {
          std::vector<std::pair<double, Motion>> motions;
          for (const Stay& stay : stays) {
            Motion motion = stand_at(placed_on(terrain, stay.at, stay.yaw_rad));
            if (speed > 0.0)
              motion = straight_on(terrain, stay.at, stay.yaw_rad, speed, stay.from_s);
            motions.emplace_back(stay.from_s, std::move(motion));
          }
          return switched(std::move(motions));
        },
        last_s + 10.0);
  }

  Drive ramp() {
    Ramp ramp;
    ramp.foot_m = place("foot");
    ramp.heading_rad = radians(reader_.number("heading_deg", 0.0, kAngle));
    ramp.angle_rad = radians(reader_.number("slope_deg", 25.0, kSlope));
    ramp.length_m = reader_.number("length_m", 6.0, kRampLength);
    ramp.width_m = reader_.number("width_m", 2.4, kRampWidth);
    const double up_share = reader_.number("up_share", 0.5, kShare);
    const double speed = reader_.number("speed_m_s", 0.15, kSpeed);
    const Vector2d along = ahead(ramp.heading_rad);
    const double up_m = up_share * ramp.length_m * cosine(ramp.angle_rad);
    const WayPoints points = {ramp.foot_m - kBeforeRamp_m * along, ramp.foot_m,
                              ramp.foot_m + std::max(up_m, 0.1) * along};
    for (const Vector2d& p : {points.front(), points.back()}) {
      if (!on_grounds(grounds_, p)) complain_outside(reader_, reader_.line("foot"), p, grounds_);
    }
    Drive drive =
        made_of([=](const Terrain& terrain) { return drive_along(terrain, points, speed, false); },
                (kBeforeRamp_m + up_m) / speed);
    drive.ramp = ramp;
    drive.way.push_back(ramp.foot_m + ramp.length_m * along);
    return drive;
  }

  Drive crane() {
    const double speed = reader_.number("speed_m_s", 0.25, kSpeed);
    const double yaw = radians(reader_.number("yaw_deg", 0.0, kAngle));
    const double vibration = reader_.number("vibration_m", 0.003, kVibration);
    std::vector<CraneLine> lines;
    double total_s = 0.0;
    for (const NumberRow& row : reader_.number_rows("lines", 6, 1, kLine)) {
      const std::vector<double>& v = row.values;
      const CraneLine line{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, speed, yaw, vibration};
      check_line(line, row.line);
      total_s += (line.to_m - line.from_m).norm() / speed;
      lines.push_back(line);
    }
    if (lines.empty()) return {};
    Drive drive = made_of([=](const Terrain&) { return crane_lines(lines); }, total_s);
    for (const LineTimes& times : crane_line_times(lines)) {
      drive.spans.push_back(
          {fmt::format("line {}", drive.spans.size() + 1), times.from_s, times.to_s});
    }
    return drive;
  }

  // A grid over the sandbox, each place with a heading of its own.
  Drive survey_grid() {
    const int columns = reader_.integer("columns", 6, kPlaces);
    const int rows = reader_.integer("rows", 3, kPlaces);
    const double margin = reader_.number("margin_m", 1.5, kMargin);
    const double dwell = reader_.number("dwell_s", 1.0, kDwell);
    if (2.0 * margin >= std::min(grounds_.length_m, grounds_.width_m)) {
      reader_.complain("margin_m", config::shortest(margin), "less than half of the sandbox");
    }
    const auto along = [](int i, int count, double length) {
      return count > 1 ? (static_cast<double>(i) / (count - 1) - 0.5) * length : 0.0;
    };
    std::vector<std::pair<Vector2d, double>> places;
    RandomStream random(seed_, 0x6121D);
    for (int row = 0; row < rows; ++row) {
      for (int i = 0; i < columns; ++i) {
        const int column = row % 2 == 0 ? i : columns - 1 - i;
        const Vector2d at{along(column, columns, grounds_.length_m - 2.0 * margin),
                          along(row, rows, grounds_.width_m - 2.0 * margin)};
        places.emplace_back(at, random.uniform(-kPi, kPi));
      }
    }
    Drive drive = made_of(
        [=](const Terrain& terrain) {
          std::vector<Pose> poses;
          poses.reserve(places.size());
          for (const auto& [at, yaw] : places) poses.push_back(placed_on(terrain, at, yaw));
          return survey_places(std::move(poses), dwell);
        },
        0.0);
    for (const auto& [at, yaw] : places) {
      const auto index = static_cast<double>(drive.spans.size());
      drive.way.push_back(at);
      drive.spans.push_back(
          {fmt::format("place {}", drive.spans.size() + 1), index * dwell, (index + 1.0) * dwell});
    }
    return drive;
  }

 private:
  Vector2d place(std::string_view key) {
    const std::vector<double> v = reader_.numbers(key, 2, std::nullopt, kPlace);
    Vector2d at(v[0], v[1]);
    if (!on_grounds(grounds_, at)) complain_outside(reader_, reader_.line(key), at, grounds_);
    return at;
  }

  void check_line(const CraneLine& line, std::size_t at_line) {
    for (const Vector3d& end : {line.from_m, line.to_m}) {
      if (!on_grounds(grounds_, end.head<2>())) {
        complain_outside(reader_, at_line, end.head<2>(), grounds_);
      }
      if (end.z() < 0.0 || end.z() > 3.0) {
        reader_.complain_at(at_line,
                            fmt::format("lines has the height {}", config::shortest(end.z())),
                            "heights from 0 to 3 metres");
      }
    }
    if (line.from_m == line.to_m) {
      reader_.complain_at(at_line, "lines has a line of no length", "two places that differ");
    }
  }

  static Motion straight_on(const Terrain& terrain, const Vector2d& at, double yaw_rad,
                            double speed, double from_s) {
    constexpr double kFar_m = 6.0;
    const Motion motion = drive_along(terrain, {at, at + kFar_m * ahead(yaw_rad)}, speed, false);
    return [motion, from_s](double time_s) { return motion(time_s - from_s); };
  }

  // Where it comes is asked of it on flat ground: no motion looks at the height for that.
  Drive made_of(std::function<Motion(const Terrain&)> motion, double until_s) {
    Drive drive;
    const Terrain flat(grounds_.length_m, grounds_.width_m, 0);
    if (reader_complained()) return drive;
    drive.way = way_of(motion(flat), until_s);
    drive.motion = std::move(motion);
    return drive;
  }

  bool reader_complained() const { return !reader_.complaint().empty(); }

  TableReader& reader_;
  const Grounds& grounds_;
  std::uint64_t seed_;
};

struct Kind {
  std::string_view word;
  Drive (MotionReader::*read)();
  std::array<std::string_view, 7> keys;  // beside `kind`; the rest is empty
};

constexpr std::array<Kind, 7> kKinds = {{
    {"drive", &MotionReader::drive, {"way_points", "speed_m_s", "closed"}},
    {"stand", &MotionReader::stand, {"at", "yaw_deg"}},
    {"crane_lines", &MotionReader::crane, {"lines", "speed_m_s", "yaw_deg", "vibration_m"}},
    {"survey_grid", &MotionReader::survey_grid, {"columns", "rows", "margin_m", "dwell_s"}},
    {"ramp",
     &MotionReader::ramp,
     {"foot", "heading_deg", "slope_deg", "length_m", "width_m", "up_share", "speed_m_s"}},
    {"kidnap", &MotionReader::kidnap, {"places", "speed_m_s"}},
    {"leave_and_return",
     &MotionReader::leave_and_return,
     {"way_points", "speed_m_s", "closed", "gone_s", "back_s"}},
}};

std::vector<std::string_view> keys_of(const Kind& kind) {
  std::vector<std::string_view> keys{"kind"};
  for (const std::string_view key : kind.keys) {
    if (!key.empty()) keys.push_back(key);
  }
  return keys;
}

// The kind is read first: it says which other keys there are.
const Kind& kind_of_motion(Complaint& complaint, const toml::table& table) {
  const auto* word = table["kind"].as_string();
  for (const Kind& kind : kKinds) {
    if (word != nullptr && word->get() == kind.word) return kind;
  }
  const auto at = table.find("kind");
  const std::size_t line =
      at == table.end() ? table.source().begin.line : at->first.source().begin.line;
  complaint.add(line,
                at == table.end() ? "[motion] has no key \"kind\""
                : word == nullptr ? fmt::format("kind is {}", config::kind_of(at->second))
                                  : fmt::format("kind is {}", config::in_quotes(word->get())),
                "one of drive, stand, crane_lines, survey_grid, ramp, kidnap, leave_and_return");
  return kKinds.front();
}

}  // namespace

Drive read_motion(Complaint& complaint, const toml::table* table, const Grounds& grounds,
                  std::uint64_t seed) {
  if (table == nullptr) {
    complaint.add(1, "no table [motion]", "a table [motion], or a [vehicle] of kind none");
    return {};
  }
  const Kind& kind = kind_of_motion(complaint, *table);
  if (!complaint.empty()) return {};
  TableReader reader(complaint, *table, "[motion]", keys_of(kind));
  MotionReader motion(reader, grounds, seed);
  Drive drive = (motion.*kind.read)();
  drive.line = reader.line();
  return drive;
}

}  // namespace dottrack::host_sim
