// [grabber], [[camera_fault]], [[camera_move]], [iris], [[iris_fault]], [light_control], [can],
// [[can_outage]] and [dots].

#include <algorithm>

#include "app/config/rig_rules.h"
#include "host_sim/scenarios/scenario_reader.h"
#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

constexpr NumberRule kMilliseconds{0.0, 1e4, "a number of milliseconds from 0 to 10000", true};
constexpr NumberRule kOpening{0.0, 1.0, "a number above 0 and up to 1"};
constexpr NumberRule kIrisSpeed{0.0, 100.0, "a number a second above 0 and up to 100"};
constexpr NumberRule kDrift{-1.0, 1.0, "a number a second from -1 to 1", true};
constexpr NumberRule kBitRate{9999.0, 1e6, "a number of bits a second from 10000 to 1000000"};
constexpr NumberRule kDataBitRate{9999.0, 8e6, "a number of bits a second from 10000 to 8000000"};
constexpr IntegerRule kBaseId{0, protocol::kLastBaseId, "a whole number from 0 to 1984"};
constexpr IntegerRule kExtendedBaseId{0, protocol::kLastExtendedBaseId,
                                      "a whole number from 0 to 536870848"};
constexpr NumberRule kTurn{-180.0, 180.0, "three numbers of degrees from -180 to 180", true};
constexpr NumberRule kShift{-10.0, 10.0, "three numbers of metres from -10 to 10", true};
constexpr NumberRule kLoad{0.0, 0.95, "a number from 0 to 0.95", true};

void read_grabber(Complaint& complaint, const toml::table& table, GrabberModel& grabber) {
  TableReader reader(complaint, table, "[grabber]", {"latency_ms", "jitter_ms", "drop_share"});
  grabber.latency_s = 1e-3 * reader.number("latency_ms", 1e3 * grabber.latency_s, kMilliseconds);
  grabber.jitter_s = 1e-3 * reader.number("jitter_ms", 1e3 * grabber.jitter_s, kMilliseconds);
  grabber.drop_share = reader.number("drop_share", grabber.drop_share, kShare);
}

// Both ends of a span of time.
template <class Span>
void read_span(TableReader& reader, Span& span) {
  span.from_s = reader.number("from_s", std::nullopt, kSeconds);
  span.to_s = reader.number("to_s", std::nullopt, kSeconds);
  if (!(span.from_s < span.to_s)) {
    reader.complain("to_s", config::shortest(span.to_s), "a time after from_s");
  }
}

std::size_t read_camera(TableReader& reader, const Scene& scene) {
  const std::string name = reader.text("camera");
  const auto camera = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                   [&](const SceneCamera& c) { return c.name == name; });
  if (camera == scene.cameras.end()) {
    reader.complain("camera", config::in_quotes(name), "the name of a camera of the scenario");
  }
  return static_cast<std::size_t>(camera - scene.cameras.begin());
}

CameraFault read_fault(Complaint& complaint, const toml::table& table, const Scene& scene) {
  TableReader reader(complaint, table, "[[camera_fault]]", {"camera", "kind", "from_s", "to_s"});
  CameraFault fault;
  fault.camera = read_camera(reader, scene);
  if (!reader.has("kind")) reader.text("kind");
  fault.kind =
      static_cast<CameraFaultKind>(reader.choice("kind", {"dead", "stuck", "torn", "late"}));
  read_span(reader, fault);
  return fault;
}

CameraMove read_move(Complaint& complaint, const toml::table& table, const Scene& scene) {
  TableReader reader(complaint, table, "[[camera_move]]",
                     {"camera", "at_s", "turn_deg", "shift_m"});
  CameraMove move;
  move.camera = read_camera(reader, scene);
  move.at_s = reader.number("at_s", std::nullopt, kSeconds);
  const auto vector = [&](std::string_view key, const NumberRule& rule) {
    const std::vector<double> v = reader.numbers(key, 3, std::vector<double>(3, 0.0), rule);
    return Eigen::Vector3d(v[0], v[1], v[2]);
  };
  move.turn_rad = radians(1.0) * vector("turn_deg", kTurn);
  move.shift_m = vector("shift_m", kShift);
  if (move.turn_rad.isZero(0.0) && move.shift_m.isZero(0.0)) {
    reader.complain("camera", "not moved at all", "turn_deg, shift_m or both");
  }
  return move;
}

void read_iris(Complaint& complaint, const toml::table& table, IrisModel& iris) {
  TableReader reader(
      complaint, table, "[iris]",
      {"opening", "min_opening", "speed_per_s", "backlash", "drift_per_s", "wear_per_s"});
  iris.opening = reader.number("opening", iris.opening, kOpening);
  iris.min_opening = reader.number("min_opening", iris.min_opening, kOpening);
  iris.speed_per_s = reader.number("speed_per_s", iris.speed_per_s, kIrisSpeed);
  iris.backlash = reader.number("backlash", iris.backlash, kShare);
  iris.drift_per_s = reader.number("drift_per_s", iris.drift_per_s, kDrift);
  iris.wear_per_s = reader.number("wear_per_s", iris.wear_per_s, kDrift);
}

IrisFault read_iris_fault(Complaint& complaint, const toml::table& table, const Scene& scene) {
  TableReader reader(complaint, table, "[[iris_fault]]", {"camera", "kind", "from_s"});
  IrisFault fault;
  fault.camera = read_camera(reader, scene);
  if (!reader.has("kind")) reader.text("kind");
  fault.kind = static_cast<IrisFaultKind>(reader.choice("kind", {"stuck", "dead"}));
  fault.from_s = reader.number("from_s", std::nullopt, kSeconds);
  return fault;
}

bool read_light_control(Complaint& complaint, const toml::table& table) {
  TableReader reader(complaint, table, "[light_control]", {"on"});
  return reader.boolean("on", false);
}

void read_can(Complaint& complaint, const toml::table& table, CanModel& can) {
  TableReader reader(
      complaint, table, "[can]",
      {"bit_rate", "data_bit_rate", "load", "error_share", "base_id", "extended", "fd"});
  can.bit_rate = reader.number("bit_rate", can.bit_rate, kBitRate);
  can.data_bit_rate = reader.number("data_bit_rate", can.data_bit_rate, kDataBitRate);
  can.load = reader.number("load", can.load, kLoad);
  can.error_share = reader.number("error_share", can.error_share, kLoad);
  can.addressing.extended = reader.boolean("extended", false);
  can.addressing.fd = reader.boolean("fd", false);
  can.addressing.base_id = static_cast<std::uint32_t>(
      reader.integer("base_id", static_cast<int>(can.addressing.base_id),
                     can.addressing.extended ? kExtendedBaseId : kBaseId));
}

}  // namespace

void read_hardware(Complaint& complaint, TableReader& root, Scene& scene) {
  if (const auto* table = root.table("grabber")) read_grabber(complaint, *table, scene.grabber);
  for (const toml::table* table : root.tables("camera_fault")) {
    scene.camera_faults.push_back(read_fault(complaint, *table, scene));
  }
  for (const toml::table* table : root.tables("camera_move")) {
    scene.camera_moves.push_back(read_move(complaint, *table, scene));
  }
  std::stable_sort(scene.camera_moves.begin(), scene.camera_moves.end(),
                   [](const CameraMove& a, const CameraMove& b) { return a.at_s < b.at_s; });
  if (const auto* table = root.table("iris")) read_iris(complaint, *table, scene.iris);
  for (const toml::table* table : root.tables("iris_fault")) {
    scene.iris_faults.push_back(read_iris_fault(complaint, *table, scene));
  }
  if (const auto* table = root.table("light_control")) {
    scene.light_control = read_light_control(complaint, *table);
  }
  if (const auto* table = root.table("can")) read_can(complaint, *table, scene.can);
  for (const toml::table* table : root.tables("can_outage")) {
    TableReader reader(complaint, *table, "[[can_outage]]", {"from_s", "to_s"});
    CanOutage outage;
    read_span(reader, outage);
    scene.can.bus_off.push_back(outage);
  }
}

DotAppearance read_appearance(Complaint& complaint, const toml::table* table) {
  DotAppearance dots;
  if (table == nullptr) return dots;
  TableReader reader(complaint, *table, "[dots]",
                     {"distance_m", "intensity_dn", "min_contrast_dn", "min_contrast_part",
                      "background_px", "max_step_m"});
  if (reader.has("distance_m")) {
    std::tie(dots.distance_min_m, dots.distance_max_m) =
        reader.number_range("distance_m", config::kDistance);
  }
  std::tie(dots.intensity_min_dn, dots.intensity_max_dn) = reader.integer_range(
      "intensity_dn", {dots.intensity_min_dn, dots.intensity_max_dn}, config::kIntensity);
  dots.min_contrast_dn = reader.integer("min_contrast_dn", dots.min_contrast_dn, config::kContrast);
  dots.min_contrast_part =
      reader.number("min_contrast_part", dots.min_contrast_part, config::kContrastPart);
  dots.background_px = reader.integer("background_px", dots.background_px, config::kBackground);
  if (dots.background_px % 2 == 0) {
    reader.complain("background_px", std::to_string(dots.background_px),
                    config::kBackground.expected);
  }
  dots.max_step_m = reader.number("max_step_m", dots.max_step_m, config::kStep);
  return dots;
}

}  // namespace dottrack::host_sim
