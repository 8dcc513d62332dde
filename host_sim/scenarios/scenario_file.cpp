#include "host_sim/scenarios/scenario_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/config/text_file.h"
#include "host_sim/scenarios/scenario_reader.h"
#include "host_sim/scenarios/visibility.h"
#include "host_sim/world/hall_lamps.h"
#include "host_sim/world/random.h"
#include "host_sim/world/rover.h"

namespace dottrack::host_sim {
namespace {

constexpr IntegerRule kTicks{1, kMaxTicks, "a whole number from 1 to 1000000"};
constexpr IntegerRule kSeed{0, std::numeric_limits<std::int64_t>::max(),
                            "a whole number, 0 or more"};
constexpr NumberRule kFrameRate{0.0, 1000.0, "a number of hertz above 0 and up to 1000"};

void read_head(Complaint& complaint, const toml::table* table, const ScenarioOverrides& overrides,
               Scene& scene) {
  static const toml::table kNothing;
  TableReader reader(complaint, table != nullptr ? *table : kNothing, "[scenario]",
                     {"name", "description", "ticks", "seed", "frame_rate_hz"});
  if (table == nullptr) complaint.add(1, "no table [scenario]", "a table [scenario]");
  scene.name = reader.text("name");
  scene.description = reader.text("description", "");
  const bool plain = std::none_of(scene.name.begin(), scene.name.end(), [](char c) {
    return c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
  if (!plain || scene.name.empty()) {
    reader.complain("name", config::in_quotes(scene.name), "a name without quotes and backslashes");
  }
  const auto ticks = reader.whole_number("ticks", static_cast<std::int64_t>(scene.ticks), kTicks);
  scene.ticks = overrides.ticks.value_or(static_cast<std::uint64_t>(ticks));
  const auto seed = reader.whole_number("seed", static_cast<std::int64_t>(scene.seed), kSeed);
  scene.seed = overrides.seed.value_or(static_cast<std::uint64_t>(seed));
  scene.frame_rate_hz = reader.number("frame_rate_hz", scene.frame_rate_hz, kFrameRate);
}

Body make_vehicle(const VehicleChoice& choice, Motion motion) {
  Model model = choice.kind == VehicleKind::hanging ? make_hanging_target(choice.target)
                                                    : make_rover(choice.target);
  return {"vehicle", std::move(model), std::move(motion)};
}

std::function<double(const Eigen::Vector2d&)> distance_to(WayPoints way) {
  if (way.empty()) return {};
  return [way = std::move(way)](const Eigen::Vector2d& p) {
    double least2 = std::numeric_limits<double>::max();
    for (const Eigen::Vector2d& place : way) {
      least2 = std::min(least2, (place - p).squaredNorm());
    }
    return std::sqrt(least2);
  };
}

// Whether any camera has the target's middle in its picture at some tick, if nothing hides it.
bool is_ever_in_view(const Scene& scene) {
  constexpr std::uint64_t kMostLooks = 2000;
  const Eigen::Vector3d middle = middle_of(scene.target);
  const std::uint64_t stride = 1 + scene.ticks / kMostLooks;
  for (std::uint64_t tick = 0; tick < scene.ticks; tick += stride) {
    const auto pose = truth(scene, static_cast<double>(tick) / scene.frame_rate_hz);
    if (pose && cameras_on(scene.cameras, pose->to_world(middle)) > 0) return true;
  }
  return false;
}

// Whoever carries the vehicle elsewhere at the instant of a frame has done so shortly before it.
Motion between_frames(Motion motion, double frame_rate_hz) {
  const double ahead_s = 0.25 / frame_rate_hz;
  return [motion = std::move(motion), ahead_s](double time_s) { return motion(time_s + ahead_s); };
}

class ScenarioReader {
 public:
  ScenarioReader(Complaint& complaint, const ScenarioOverrides& overrides)
      : complaint_(complaint), overrides_(overrides) {}

  Scene read(const toml::table& file) {
    TableReader root(
        complaint_, file, "the scenario",
        {"scenario", "hall",         "vehicle",     "motion",  "light",      "light_change",
         "person",   "look_alike",   "cover",       "cameras", "camera",     "sensor",
         "grabber",  "camera_fault", "camera_move", "iris",    "iris_fault", "light_control",
         "can",      "can_outage",   "dots"});
    read_head(complaint_, root.table("scenario"), overrides_, scene_);
    Grounds grounds = read_hall(complaint_, root.table("hall"), scene_.seed);
    scene_.length_m = grounds.length_m;
    scene_.width_m = grounds.width_m;
    const VehicleChoice vehicle =
        read_vehicle(complaint_, root.table("vehicle"), overrides_.layout_seed);
    scene_.target = vehicle.target;
    const Drive drive = read_drive(root, vehicle.kind, grounds);
    scene_.world.light = read_light(complaint_, root.table("light"), root.tables("light_change"));
    scene_.cameras = read_cameras(complaint_, root, grounds, scene_.seed);
    if (complaint_.empty()) read_hardware(complaint_, root, scene_);
    scene_.appearance = read_appearance(complaint_, root.table("dots"));
    scene_.terrain = Terrain(grounds.length_m, grounds.width_m, scene_.seed, drive.ramp);
    populate(root, grounds, vehicle, drive);
    if (complaint_.empty()) check_view(drive);
    if (complaint_.empty()) furnish(grounds, drive);
    return std::move(scene_);
  }

 private:
  Drive read_drive(TableReader& root, VehicleKind kind, const Grounds& grounds) {
    const toml::table* table = root.table("motion");
    if (kind != VehicleKind::none) return read_motion(complaint_, table, grounds, scene_.seed);
    if (table != nullptr) {
      complaint_.add(root.line("motion"), "[motion] without a vehicle",
                     "no [motion] with a [vehicle] of kind none");
    }
    return {};
  }

  void populate(TableReader& root, const Grounds& grounds, const VehicleChoice& vehicle,
                const Drive& drive) {
    Motion motion;
    if (drive.motion && complaint_.empty()) {
      motion = between_frames(drive.motion(scene_.terrain), scene_.frame_rate_hz);
      scene_.spans = drive.spans;
      scene_.vehicle = scene_.world.bodies.size();
      scene_.world.bodies.push_back(make_vehicle(vehicle, motion));
    }
    read_bodies(complaint_, root, grounds, scene_.terrain, motion, scene_.seed,
                scene_.world.bodies);
  }

  void check_view(const Drive& drive) {
    if (!scene_.vehicle || is_ever_in_view(scene_)) return;
    complaint_.add(drive.line, "no camera sees the target at any tick",
                   "a motion that comes into a camera's picture");
  }

  void furnish(Grounds& grounds, const Drive& drive) {
    scene_.world.lamps =
        hall_lamps(grounds.length_m, grounds.width_m, grounds.hall.height_m, scene_.seed);
    grounds.hall.distance_to_drive_m = distance_to(drive.way);
    scene_.world.hall = make_hall(grounds.hall, scene_.terrain, scene_.world.lamps);
    scene_.calibration_dots = static_cast<std::size_t>(grounds.hall.calibration_dots) +
                              static_cast<std::size_t>(grounds.hall.calibration_boxes);
  }

  Complaint& complaint_;
  const ScenarioOverrides& overrides_;
  Scene scene_;
};

}  // namespace

Result<Scene> parse_scenario(const std::string& text, const std::string& name,
                             const ScenarioOverrides& overrides) {
  if (overrides.ticks && (*overrides.ticks < 1 || *overrides.ticks > kMaxTicks)) {
    return fail(fmt::format("ticks is {}; expected {}", *overrides.ticks, kTicks.expected));
  }
  Complaint complaint(name);
  Scene scene;
  try {
    scene = ScenarioReader(complaint, overrides).read(toml::parse(text));
  } catch (const toml::parse_error& error) {
    complaint.add(error.source().begin.line, error.description(), "TOML");
  }
  if (!complaint.empty()) return tl::unexpected<Error>(complaint.first());
  return scene;
}

Result<Scene> load_scenario(const std::filesystem::path& file, const ScenarioOverrides& overrides) {
  const Result<std::string> text = config::read_text_file(file);
  if (text) return parse_scenario(*text, file.string(), overrides);
  Complaint complaint(file.string());
  complaint.add(0, text.error().message, "a scenario file");
  return tl::unexpected<Error>(complaint.first());
}

}  // namespace dottrack::host_sim
