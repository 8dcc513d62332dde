// [cameras], [[camera]] and [sensor].

#include <fmt/format.h>

#include <algorithm>

#include "hal/base/camera_set.h"
#include "host_sim/scenarios/ceiling.h"
#include "host_sim/scenarios/scenario_reader.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

constexpr IntegerRule kCount{2, kMaxCameras, "a whole number from 2 to 16"};
constexpr IntegerRule kPixels{32, 2048, "a whole number from 32 to 2048"};
constexpr NumberRule kField{20.0, 120.0, "two numbers of degrees, 20 < least < most <= 120"};
constexpr NumberRule kHeight{1.0, 30.0, "a number of metres above 1 and up to 30"};
constexpr NumberRule kPoint{-100.0, 100.0, "a point [x, y, z] in metres"};
constexpr NumberRule kBlur{0.0, 1.5, "a number of pixels from 0 to 1.5", true};
constexpr NumberRule kNoise{0.0, 50.0, "a number of DN from 0 to 50", true};
constexpr NumberRule kElectrons{0.0, 1e6, "a number above 0 and up to 1000000"};
constexpr NumberRule kWell{254.9, 1e6, "a number of DN, 255 or more"};
constexpr NumberRule kBlack{0.0, 100.0, "a number of DN from 0 to 100", true};
constexpr NumberRule kSensitivity{0.0, 100.0, "a number above 0 and up to 100"};
constexpr NumberRule kLineTime{0.0, 1000.0, "a number of microseconds above 0 and up to 1000"};
constexpr NumberRule kExposure{0.0, 100.0, "a number of milliseconds above 0 and up to 100"};
constexpr NumberRule kGain{0.0, 64.0, "a number above 0 and up to 64"};

struct SensorChoice {
  SensorModel model;
  double exposure_s = 0.006;
  double gain = 1.0;
};

SensorChoice read_sensor(Complaint& complaint, const toml::table* table) {
  SensorChoice choice;
  if (table == nullptr) return choice;
  TableReader reader(complaint, *table, "[sensor]",
                     {"blur_px", "sensitivity", "corner_falloff", "black_level_dn", "noise",
                      "read_noise_dn", "electrons_per_dn", "bloom_share", "full_well_dn", "shutter",
                      "line_time_us", "exposure_ms", "gain"});
  SensorModel& model = choice.model;
  model.blur_sigma_px = reader.number("blur_px", model.blur_sigma_px, kBlur);
  model.sensitivity = reader.number("sensitivity", model.sensitivity, kSensitivity);
  model.corner_falloff = reader.number("corner_falloff", model.corner_falloff, kShare);
  model.black_level_dn = reader.number("black_level_dn", model.black_level_dn, kBlack);
  model.noise = reader.boolean("noise", model.noise);
  model.read_noise_dn = reader.number("read_noise_dn", model.read_noise_dn, kNoise);
  model.electrons_per_dn = reader.number("electrons_per_dn", model.electrons_per_dn, kElectrons);
  model.bloom_share = reader.number("bloom_share", model.bloom_share, kShare);
  model.full_well_dn = reader.number("full_well_dn", model.full_well_dn, kWell);
  const bool rolling = reader.choice("shutter", {"global", "rolling"}) == 1;
  const double line_time_us = reader.number("line_time_us", 30.0, kLineTime);
  if (rolling) model.line_time_s = 1e-6 * line_time_us;
  if (!rolling && reader.has("line_time_us")) {
    reader.complain("line_time_us", "of no use", "it with shutter = \"rolling\" only");
  }
  choice.exposure_s = 1e-3 * reader.number("exposure_ms", 1e3 * choice.exposure_s, kExposure);
  choice.gain = reader.number("gain", choice.gain, kGain);
  return choice;
}

struct NamedPlace {
  std::string name;
  CameraPlace place;
};

CeilingOptions read_options(TableReader& reader, const Grounds& grounds, std::uint64_t seed) {
  CeilingOptions options;
  options.seed = seed;
  options.length_m = grounds.length_m;
  options.width_m = grounds.width_m;
  options.cameras = reader.integer("count", options.cameras, kCount);
  options.width_px = reader.integer("width_px", options.width_px, kPixels);
  options.height_px = reader.integer("height_px", options.height_px, kPixels);
  options.height_m = reader.number("height_m", options.height_m, kHeight);
  if (reader.has("field_deg")) {
    const auto [least, most] = reader.number_range("field_deg", kField);
    options.field_min_deg = least;
    options.field_max_deg = most;
  }
  constexpr std::array kLenses = {LensKind::radial, LensKind::pinhole, LensKind::fisheye};
  options.lens = kLenses[reader.choice("lens", {"radial", "pinhole", "fisheye"})];
  return options;
}

bool is_file_name(std::string_view name) {
  constexpr std::string_view kAllowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
  return !name.empty() && name.find_first_not_of(kAllowed) == std::string_view::npos;
}

NamedPlace read_place(Complaint& complaint, const toml::table& table,
                      const std::vector<NamedPlace>& others) {
  TableReader reader(complaint, table, "[[camera]]", {"name", "at", "aim", "roll_deg"});
  const auto point = [&](std::string_view key) {
    const std::vector<double> v = reader.numbers(key, 3, std::nullopt, kPoint);
    return Eigen::Vector3d(v[0], v[1], v[2]);
  };
  NamedPlace place;
  place.name = reader.text("name", fmt::format("cam{}", others.size() + 1));
  place.place.at_m = point("at");
  place.place.aim_m = point("aim");
  place.place.roll_rad = radians(reader.number("roll_deg", 0.0, kAngle));
  if (!is_file_name(place.name)) {
    reader.complain("name", config::in_quotes(place.name),
                    "a folder's name of letters, digits, - and _");
  }
  const bool taken = std::any_of(others.begin(), others.end(),
                                 [&](const NamedPlace& other) { return other.name == place.name; });
  if (taken) reader.complain("name", config::in_quotes(place.name) + " again", "every name once");
  if (place.place.at_m == place.place.aim_m) {
    reader.complain("aim", "where the camera is", "a point that it looks at");
  }
  return place;
}

std::vector<NamedPlace> read_places(Complaint& complaint, TableReader& root,
                                    const CeilingOptions& options, bool has_count) {
  std::vector<NamedPlace> places;
  const auto tables = root.tables("camera");
  if (tables.empty()) {
    for (const CameraPlace& place : ceiling_places(options)) {
      places.push_back({fmt::format("cam{}", places.size() + 1), place});
    }
    return places;
  }
  const std::size_t line = tables[std::min(tables.size() - 1, kMaxCameras)]->source().begin.line;
  if (has_count) complaint.add(line, "count and [[camera]]", "one of them");
  if (tables.size() < 2 || tables.size() > kMaxCameras) {
    complaint.add(line, fmt::format("{} cameras", tables.size()), "2 to 16 tables [[camera]]");
  }
  for (const toml::table* table : tables) {
    places.push_back(read_place(complaint, *table, places));
  }
  return places;
}

}  // namespace

std::vector<SceneCamera> read_cameras(Complaint& complaint, TableReader& root,
                                      const Grounds& grounds, std::uint64_t seed) {
  static const toml::table kNothing;
  const toml::table* table = root.table("cameras");
  TableReader reader(complaint, table != nullptr ? *table : kNothing, "[cameras]",
                     {"count", "width_px", "height_px", "field_deg", "lens", "height_m"});
  const CeilingOptions options = read_options(reader, grounds, seed);
  const SensorChoice sensor = read_sensor(complaint, root.table("sensor"));
  std::vector<SceneCamera> cameras;
  for (const NamedPlace& place : read_places(complaint, root, options, reader.has("count"))) {
    if (!complaint.empty()) break;
    const std::size_t index = cameras.size();
    SceneCamera camera{place.name, ceiling_camera(options, index, place.place), sensor.model,
                       sensor.exposure_s, sensor.gain};
    camera.sensor.sensitivity *= RandomStream(seed, 0x5E45 + index).uniform(0.95, 1.05);
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

}  // namespace dottrack::host_sim
