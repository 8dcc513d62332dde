#include "app/config/unit_reader.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "app/config/can_reader.h"

namespace dottrack::config {
namespace {

constexpr NumberRule kExposure{0.0, 1000.0, "a number of milliseconds above 0 and up to 1000"};
constexpr NumberRule kGain{0.0, 1000.0, "a number above 0 and up to 1000"};
constexpr NumberRule kStampOffset{-1000.0, 1000.0, "a number of milliseconds from -1000 to 1000",
                                  true};
constexpr IntegerRule kLine{0, 1023, "a whole number from 0 to 1023"};
constexpr IntegerRule kTravel{1, 100'000, "a whole number from 1 to 100000"};
constexpr IntegerRule kBacklash{0, 1000, "a whole number from 0 to 1000"};
constexpr NumberRule kStepRate{0.0, 2000.0, "a number of steps a second above 0 and up to 2000"};
constexpr NumberRule kLimits{0.0, 1.0, "two numbers, 0 <= narrowest < widest <= 1", true};
constexpr NumberRule kOpening{0.0, 1.0, "a number from 0 to 1", true};
constexpr IntegerRule kPriority{1, 99, "a whole number from 1 to 99"};
constexpr IntegerRule kCpu{0, 1023, "a whole number from 0 to 1023"};
constexpr NumberRule kWatchdog{0.999, 600.0, "a number of seconds from 1 to 600"};
constexpr NumberRule kFree{0.0, 1e9, "a number of megabytes from 0 to 1000000000", true};

std::string chip_of(TableReader& reader) {
  std::string chip = reader.text("chip");
  if (chip.empty() && reader.has("chip")) {
    reader.complain("chip", "empty", "the label, name or path of a GPIO chip");
  }
  return chip;
}

unsigned line_of(TableReader& reader, std::string_view key) {
  return static_cast<unsigned>(reader.integer(key, std::nullopt, kLine));
}

std::optional<unsigned> optional_line_of(TableReader& reader, std::string_view key) {
  if (!reader.has(key)) return std::nullopt;
  return line_of(reader, key);
}

LineConfig read_line(TableReader& reader) {
  LineConfig line;
  line.chip = chip_of(reader);
  line.line = line_of(reader, "line");
  line.active_low = reader.boolean("active_low", false);
  return line;
}

IrisConfig read_iris(Complaint& complaint, const toml::table& table) {
  TableReader reader(complaint, table, "iris",
                     {"chip", "step", "direction", "enable", "auto", "end_stop", "travel_steps",
                      "steps_per_s", "backlash_steps", "limits", "opening"});
  IrisConfig iris;
  iris.chip = chip_of(reader);
  iris.step_line = line_of(reader, "step");
  iris.direction_line = line_of(reader, "direction");
  iris.enable_line = optional_line_of(reader, "enable");
  iris.auto_line = optional_line_of(reader, "auto");
  iris.end_stop_line = optional_line_of(reader, "end_stop");
  iris.travel_steps = reader.integer("travel_steps", std::nullopt, kTravel);
  iris.steps_per_s = reader.number("steps_per_s", iris.steps_per_s, kStepRate);
  iris.backlash_steps = reader.integer("backlash_steps", iris.backlash_steps, kBacklash);
  std::tie(iris.limits[0], iris.limits[1]) =
      reader.number_range("limits", kLimits, std::pair(iris.limits[0], iris.limits[1]));
  iris.opening = reader.number("opening", iris.opening, kOpening);
  if (iris.opening < iris.limits[0] || iris.opening > iris.limits[1]) {
    reader.complain("opening", shortest(iris.opening), "a number within limits");
  }
  return iris;
}

void read_trigger(Complaint& complaint, const toml::table& table, UnitConfig& unit) {
  TableReader reader(complaint, table, "[trigger]",
                     {"chip", "line", "active_low", "cameras_follow"});
  unit.trigger = TriggerConfig{read_line(reader), reader.boolean("cameras_follow", true)};
}

void read_lamp(Complaint& complaint, const toml::table& table, UnitConfig& unit) {
  TableReader reader(complaint, table, "[lamp]", {"chip", "line", "active_low"});
  unit.lamp = read_line(reader);
}

constexpr NumberRule kTargetPart{0.2, 0.95, "a number above 0.2 and up to 0.95"};
constexpr NumberRule kExposures{0.0, 1000.0,
                                "two numbers of milliseconds, 0 < shortest < longest <= 1000"};
constexpr NumberRule kGains{0.0, 1000.0, "two numbers, 0 < least < most <= 1000"};
constexpr IntegerRule kDelay{1, 30, "a whole number from 1 to 30"};
constexpr NumberRule kBlur{0.0, 100.0, "a number of pixels above 0 and up to 100"};

void read_light(Complaint& complaint, const toml::table& table, LightConfig& light) {
  TableReader reader(
      complaint, table, "[light]",
      {"control", "target_part", "exposure_ms", "gain", "delay_ticks", "max_blur_px"});
  const auto range = [&](std::string_view key, std::array<double, 2>& limits,
                         const NumberRule& rule) {
    std::tie(limits[0], limits[1]) =
        reader.number_range(key, rule, std::pair(limits[0], limits[1]));
  };
  light.control = reader.boolean("control", light.control);
  light.target_part = reader.number("target_part", light.target_part, kTargetPart);
  range("exposure_ms", light.exposure_ms, kExposures);
  range("gain", light.gain, kGains);
  light.delay_ticks = reader.integer("delay_ticks", light.delay_ticks, kDelay);
  light.max_blur_px = reader.number("max_blur_px", light.max_blur_px, kBlur);
}

void read_loop(Complaint& complaint, const toml::table& table, LoopConfig& loop) {
  TableReader reader(complaint, table, "[loop]", {"priority", "cpu", "watchdog", "watchdog_s"});
  loop.priority = reader.integer("priority", loop.priority, kPriority);
  if (reader.has("cpu")) loop.cpu = reader.integer("cpu", std::nullopt, kCpu);
  loop.watchdog = reader.text("watchdog", loop.watchdog);
  loop.watchdog_s = reader.number("watchdog_s", loop.watchdog_s, kWatchdog);
}

void read_recording(Complaint& complaint, const toml::table& table, UnitConfig& unit) {
  TableReader reader(complaint, table, "[recording]", {"folder", "frames", "min_free_mb"});
  RecordingConfig recording;
  recording.folder = reader.text("folder");
  if (!recording.folder.is_absolute() && reader.has("folder")) {
    reader.complain("folder", in_quotes(recording.folder.string()), "an absolute path");
  }
  recording.frames = reader.boolean("frames", recording.frames);
  recording.min_free_mb = reader.number("min_free_mb", recording.min_free_mb, kFree);
  unit.recording = std::move(recording);
}

const toml::table* find_table(Complaint& complaint, const toml::table& root, std::string_view key) {
  const toml::node* node = root.get(key);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) {
    complaint.add(root.find(key)->first.source().begin.line,
                  fmt::format("{} is {}", key, kind_of(*node)), fmt::format("a table [{}]", key));
  }
  return node->as_table();
}

}  // namespace

CameraUnitConfig read_camera_unit(Complaint& complaint, TableReader& camera) {
  CameraUnitConfig unit;
  unit.device = camera.text("device", "");
  unit.exposure_ms = camera.number("exposure_ms", unit.exposure_ms, kExposure);
  unit.gain = camera.number("gain", unit.gain, kGain);
  unit.stamp_offset_ms = camera.number("stamp_offset_ms", unit.stamp_offset_ms, kStampOffset);
  if (const auto* iris = camera.table("iris")) unit.iris = read_iris(complaint, *iris);
  return unit;
}

void read_unit(Complaint& complaint, const toml::table& root, UnitConfig& unit) {
  const auto table = [&](std::string_view key) { return find_table(complaint, root, key); };
  if (const auto* light = table("light")) read_light(complaint, *light, unit.light);
  unit.can.rates.light_every = unit.light.control ? 1 : 0;
  if (const auto* can = table("can")) read_can(complaint, *can, unit.can);
  if (const auto* trigger = table("trigger")) read_trigger(complaint, *trigger, unit);
  if (const auto* lamp = table("lamp")) read_lamp(complaint, *lamp, unit);
  if (const auto* loop = table("loop")) read_loop(complaint, *loop, unit.loop);
  if (const auto* recording = table("recording")) read_recording(complaint, *recording, unit);
}

}  // namespace dottrack::config
