#include "app/config/rig_file.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <boost/crc.hpp>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "app/config/camera_file.h"
#include "app/config/complaint.h"
#include "app/config/joint_covariance.h"
#include "app/config/model_correlation.h"
#include "app/config/model_errors.h"
#include "app/config/rig_rules.h"
#include "app/config/table_reader.h"
#include "app/config/target_admission.h"
#include "app/config/target_file.h"
#include "app/config/target_reader.h"
#include "app/config/text_file.h"
#include "app/config/unit_reader.h"
#include "app/config/vehicle_reader.h"

namespace dottrack::config {
namespace {

constexpr NumberRule kFrameRate{0.0, 1000.0, "a number of hertz above 0 and up to 1000"};
constexpr NumberRule kResidual{0.0, 10.0, "a number of metres above 0 and up to 10"};
constexpr NumberRule kFalseLock{0.0, 0.5, "a probability above 0 and up to 0.5"};
constexpr IntegerRule kWatchEvery{0, 1'000'000, "a whole number from 0 (never) to 1000000"};
constexpr NumberRule kCoast{0.0, 10'000.0, "a number of milliseconds from 0 (never) to 10000",
                            true};
constexpr IntegerRule kLostAfter{1, 1'000'000, "a whole number from 1 to 1000000"};

// A camera's name is also the name of a folder and of files.
bool is_folder_name(std::string_view name) {
  constexpr std::string_view kAllowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
  return !name.empty() && name.find_first_not_of(kAllowed) == std::string_view::npos;
}

class RigReader {
 public:
  RigReader(const std::filesystem::path& path, Targets judging)
      : path_(path), judging_(judging), complaint_(path.string()) {}

  Result<RigConfig> read() {
    const Result<std::string> text = read_text_file(path_);
    if (text) {
      sum_.process_bytes(text->data(), text->size());
      read_text(*text);
    } else {
      complaint_.add(0, text.error().message, "a rig file");
    }
    if (!complaint_.empty()) return tl::unexpected<Error>(complaint_.first());
    config_.config_hash = sum_.checksum();
    return with_target(std::move(config_), 0);
  }

 private:
  void read_text(const std::string& text) {
    try {
      read_root(toml::parse(text));
    } catch (const toml::parse_error& error) {
      complaint_.add(error.source().begin.line, error.description(), "TOML");
    }
  }

  void read_root(const toml::table& root) {
    TableReader reader(complaint_, root, "the rig file",
                       {"rig", "camera", "target", "vehicle", "tracking", "can", "trigger", "lamp",
                        "light", "loop", "recording"});
    if (const auto* table = find_table(root, "rig")) read_rig(*table);
    read_cameras(root);
    targets_ = read_targets(complaint_, root);
    if (const auto* table = find_table(root, "vehicle")) {
      config_.rig.vehicle = read_vehicle(complaint_, *table);
    }
    if (const auto* table = find_table(root, "tracking")) read_tracking(*table);
    read_unit(complaint_, root, config_.unit);
    if (complaint_.empty()) load_files();
    if (complaint_.empty()) check_bus_load(root);
  }

  const toml::table* find_table(const toml::table& root, std::string_view key) {
    const toml::node* node = root.get(key);
    if (node == nullptr) return nullptr;
    if (!node->is_table()) {
      complaint_.add(line_of(root, key), fmt::format("{} is {}", key, kind_of(*node)),
                     fmt::format("a table [{}]", key));
    }
    return node->as_table();
  }

  static std::size_t line_of(const toml::table& table, std::string_view key) {
    return table.find(key)->first.source().begin.line;
  }

  void read_rig(const toml::table& table) {
    TableReader reader(complaint_, table, "[rig]", {"name", "frame_rate_hz", "joint_covariance"});
    config_.name = reader.text("name", config_.name);
    config_.frame_rate_hz = reader.number("frame_rate_hz", config_.frame_rate_hz, kFrameRate);
    rate_line_ = reader.line("frame_rate_hz");
    joint_name_ = reader.text("joint_covariance", "");
    joint_line_ = reader.line("joint_covariance");
  }

  void read_cameras(const toml::table& root) {
    constexpr std::string_view kExpected = "2 to 16 tables [[camera]]";
    const toml::node* node = root.get("camera");
    if (node == nullptr) return complaint_.add(1, "no table [[camera]]", kExpected);
    const toml::array* list = node->as_array();
    if (list == nullptr || !list->is_array_of_tables()) {
      return complaint_.add(node->source().begin.line, fmt::format("camera is {}", kind_of(*node)),
                            kExpected);
    }
    if (list->size() < 2 || list->size() > kMaxCameras) {
      const std::size_t last = std::min(list->size() - 1, kMaxCameras);
      return complaint_.add(list->get(last)->source().begin.line,
                            fmt::format("{} cameras", list->size()), kExpected);
    }
    for (const toml::node& camera : *list) read_camera(*camera.as_table());
  }

  void read_camera(const toml::table& table) {
    TableReader reader(
        complaint_, table, "[[camera]]",
        {"name", "model", "distance_m", "intensity_dn", "min_contrast_dn", "min_contrast_part",
         "background_px", "polarity", "device", "exposure_ms", "gain", "stamp_offset_ms", "iris"});
    CameraEntry entry;
    entry.name = reader.text("name");
    check_camera_name(reader, entry.name);
    entry.model_path = beside_rig(reader.text("model"));
    config_.unit.cameras[config_.cameras.size()] = read_camera_unit(complaint_, reader);
    config_.cameras.push_back(std::move(entry));
    config_.rig.cameras.push_back(read_camera_limits(reader));
    name_lines_.push_back(reader.line("name"));
    model_lines_.push_back(reader.line("model"));
  }

  void check_camera_name(TableReader& reader, const std::string& name) {
    if (!is_folder_name(name)) {
      reader.complain("name", in_quotes(name), "a folder's name of letters, digits, - and _");
    }
    const auto same = std::find_if(config_.cameras.begin(), config_.cameras.end(),
                                   [&](const CameraEntry& other) { return other.name == name; });
    if (same == config_.cameras.end()) return;
    const auto earlier = name_lines_[static_cast<std::size_t>(same - config_.cameras.begin())];
    reader.complain("name", fmt::format("{} again, first on line {}", in_quotes(name), earlier),
                    "a name of its own for every camera");
  }

  core::Camera read_camera_limits(TableReader& reader) {
    core::Camera camera;
    std::tie(camera.distance_min_m, camera.distance_max_m) =
        reader.number_range("distance_m", kDistance);
    std::tie(camera.intensity_min_dn, camera.intensity_max_dn) =
        reader.integer_range("intensity_dn", {0, 255}, kIntensity);
    camera.min_contrast_dn = reader.integer("min_contrast_dn", 0, kContrast);
    camera.min_contrast_part = reader.number("min_contrast_part", 0.0, kContrastPart);
    camera.background_px = reader.integer("background_px", 21, kBackground);
    if (camera.background_px % 2 == 0) {
      reader.complain("background_px", std::to_string(camera.background_px), kBackground.expected);
    }
    camera.polarity = read_polarity(reader);
    check_selective(reader, camera);
    return camera;
  }

  core::Polarity read_polarity(TableReader& reader) {
    const std::string polarity = reader.text("polarity", "bright");
    if (polarity == "dark") return core::Polarity::dark;
    if (polarity != "bright") reader.complain("polarity", in_quotes(polarity), "bright or dark");
    return core::Polarity::bright;
  }

  // With every intensity and no contrast asked for, the whole image would be one region.
  void check_selective(const TableReader& reader, const core::Camera& camera) {
    const bool any = camera.intensity_min_dn == 0 && camera.intensity_max_dn == 255;
    if (!any || camera.min_contrast_dn > 0 || camera.min_contrast_part > 0.0) return;
    complaint_.add(
        reader.line("intensity_dn"), "this camera takes every pixel for a dot's",
        "intensity_dn narrower than [0, 255], or min_contrast_dn or min_contrast_part above 0");
  }

  void read_tracking(const toml::table& table) {
    TableReader reader(complaint_, table, "[tracking]",
                       {"max_rms_residual_m", "lost_after_ticks", "max_false_lock_probability",
                        "watch_every_ticks", "coast_ms"});
    auto& limits = config_.rig.limits;
    limits.max_rms_residual_m =
        reader.number("max_rms_residual_m", limits.max_rms_residual_m, kResidual);
    limits.lost_after_ticks =
        reader.integer("lost_after_ticks", limits.lost_after_ticks, kLostAfter);
    limits.max_false_lock_probability =
        reader.number("max_false_lock_probability", limits.max_false_lock_probability, kFalseLock);
    limits.watch_every_ticks =
        reader.integer("watch_every_ticks", limits.watch_every_ticks, kWatchEvery);
    const std::chrono::duration<double, std::milli> coast(
        reader.number("coast_ms", 1e3 * to_seconds(limits.coast), kCoast));
    limits.coast = std::chrono::round<Duration>(coast);
  }

  std::filesystem::path beside_rig(const std::string& name) const {
    return path_.parent_path() / name;
  }

  // The other files are opened only when the rig file itself is right.
  void load_files() {
    for (std::size_t i = 0; i < config_.cameras.size(); ++i) load_model(i);
    if (!joint_name_.empty()) load_joint_covariance();
    const double sigma_m = complaint_.empty() ? expected_sigma_m(config_.rig) : 0.0;
    for (NamedTarget& target : targets_) load_dots(target, sigma_m);
  }

  void load_model(std::size_t index) {
    const std::filesystem::path& path = config_.cameras[index].model_path;
    const std::size_t line = model_lines_[index];
    const auto text =
        load_text("model", path, line, "a camera model file, relative to the rig file");
    if (!text) return;
    Result<CameraFile> file = parse_camera_text(*text, path.string());
    if (!file) return complaint_.add(file.error());
    if (!file->dimensions) {
      return complaint_.add(line,
                            fmt::format("model {} has no Dimensions", in_quotes(path.string())),
                            "the image size, as in Dimensions = 640 480");
    }
    core::Camera& camera = config_.rig.cameras[index];
    camera.model = file->model;
    camera.width_px = file->dimensions->columns;
    camera.height_px = file->dimensions->rows;
    check_dimensions(camera, path, line);
    if (!complaint_.empty()) return;
    ModelReading& reading = readings_.emplace_back();
    if (!file->covariance) return;
    reading.covariance = *file->covariance;
    reading.of_vectors = set_model_errors(reading.covariance, camera);
  }

  void load_joint_covariance() {
    const std::filesystem::path path = beside_rig(joint_name_);
    const auto text =
        load_text("joint_covariance", path, joint_line_, "a file that dottrack calibrate wrote");
    if (!text) return;
    const Result<JointCovariance> joint = parse_joint_covariance(*text, path.string());
    if (!joint) return complaint_.add(joint.error());
    if (!complaint_.empty()) return;
    std::vector<std::string> names;
    for (const CameraEntry& camera : config_.cameras) names.push_back(camera.name);
    const std::vector<std::size_t> strangers =
        correlate(*joint, names, readings_, config_.rig.model_correlations);
    if (strangers.size() == names.size()) {
      return complaint_.add(joint_line_,
                            in_quotes(path.string()) + " has the covariance of none of the models",
                            "the file of the calibration that made them");
    }
    for (const std::size_t i : strangers) {
      config_.warnings.push_back(fmt::format(
          "{}: the model of {} is not of this calibration: its errors are taken as its own",
          path.string(), names[i]));
    }
  }

  void load_dots(NamedTarget& target, double sigma_m) {
    const std::filesystem::path path = beside_rig(target.dots);
    const auto text =
        load_text("dots", path, target.dots_line, "a target file, relative to the rig file");
    if (!text) return;
    Result<TargetFile> file = parse_target_text(*text, path.string());
    if (!file) return complaint_.add(file.error());
    target.target.dots = file->dots;
    if (complaint_.empty() && judging_ == Targets::judged)
      admit(target, *file, path.string(), sigma_m);
    config_.targets.push_back({std::move(target.name), target.target});
  }

  void admit(const NamedTarget& target, const TargetFile& file, const std::string& path,
             double sigma_m) {
    auto warnings = admit_target(target.target, file, path, {sigma_m, target.allow_ambiguous});
    if (!warnings) return complaint_.add(warnings.error());
    std::move(warnings->begin(), warnings->end(), std::back_inserter(config_.warnings));
  }

  void check_dimensions(const core::Camera& camera, const std::filesystem::path& path,
                        std::size_t line) {
    const bool fits = camera.width_px >= 1 && camera.width_px <= core::kMaxImageWidth &&
                      camera.height_px >= 1 && camera.height_px <= core::kMaxImageHeight;
    if (fits) return;
    complaint_.add(line,
                   fmt::format("model {} is of {} x {} pixels", in_quotes(path.string()),
                               camera.width_px, camera.height_px),
                   fmt::format("up to {} x {}", core::kMaxImageWidth, core::kMaxImageHeight));
  }

  std::optional<std::string> load_text(std::string_view key, const std::filesystem::path& path,
                                       std::size_t line, std::string_view expected) {
    Result<std::string> text = read_text_file(path);
    if (!text) {
      complaint_.add(
          line, fmt::format("{} is {}: {}", key, in_quotes(path.string()), text.error().message),
          expected);
      return std::nullopt;
    }
    sum_.process_bytes(text->data(), text->size());
    return std::move(*text);
  }

  // A rig without [can] has the defaults, which its frame rate may make too much.
  void check_bus_load(const toml::table& root) {
    const auto too_much = overload(can_use(config_));
    if (!too_much) return;
    if (root.contains("can")) {
      return complaint_.add(line_of(root, "can"), too_much->what, too_much->expected);
    }
    complaint_.add(rate_line_,
                   fmt::format("{} (the defaults of [can], at frame_rate_hz = {})", too_much->what,
                               shortest(config_.frame_rate_hz)),
                   too_much->expected);
  }

  std::filesystem::path path_;
  Targets judging_;
  Complaint complaint_;
  RigConfig config_;
  std::vector<std::size_t> name_lines_;
  std::vector<std::size_t> model_lines_;
  std::vector<NamedTarget> targets_;
  std::size_t rate_line_ = 1;
  std::string joint_name_;
  std::size_t joint_line_ = 1;
  std::vector<ModelReading> readings_;  // in the order of the cameras
  boost::crc_32_type sum_;              // of the bytes of all files so far
};

}  // namespace

Result<RigConfig> load_rig(const std::filesystem::path& path, Targets targets) {
  return RigReader(path, targets).read();
}

RigConfig with_target(RigConfig config, std::size_t index) {
  const TargetEntry& entry = config.targets[index];
  config.target_index = index;
  config.target_name = entry.name;
  config.rig.target = entry.target;
  return config;
}

CanUse can_use(const RigConfig& config) {
  CanUse use{.can = config.unit.can, .dots = 0, .frame_rate_hz = config.frame_rate_hz};
  for (const TargetEntry& entry : config.targets) {
    use.dots = std::max(use.dots, static_cast<unsigned>(entry.target.dots.size()));
  }
  return use;
}

}  // namespace dottrack::config
