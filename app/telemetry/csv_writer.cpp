#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "app/telemetry/pose_files.h"

namespace dottrack::telemetry {
namespace {

using core::AcquisitionCounts;
using core::TickResult;

constexpr std::array<std::string_view, 6> kAxes = {"x", "y", "z", "roll", "pitch", "yaw"};
constexpr std::size_t kPoseColumns = 7 + 1 + 21;
constexpr std::size_t kFilteredColumns = 7 + 21 + 6;

// Fields of one line, with commas between them. Numbers are as short as they can be and still read
// back to the same value.
class Line {
 public:
  explicit Line(std::string& text) : text_(text) { text_.clear(); }

  template <class T>
  Line& operator<<(const T& value) {
    if (!text_.empty()) text_ += ',';
    fmt::format_to(std::back_inserter(text_), "{}", value);
    return *this;
  }
  Line& operator<<(bool value) { return *this << (value ? 1 : 0); }

  void skip(std::size_t fields) { text_.append(fields, ','); }
  void end() { text_ += '\n'; }

 private:
  std::string& text_;
};

void write_time(const CycleRecord& record, Line& line) {
  const std::int64_t ns = record.stamp.time_since_epoch().count();
  line << record.result.tick << fmt::format("{}.{:09}", ns / 1000000000, ns % 1000000000);
}

std::string_view word_of(core::Relock relock) {
  if (relock == core::Relock::jumped) return "jumped";
  return relock == core::Relock::better_elsewhere ? "better_elsewhere" : "none";
}

void write_place(const core::Pose& pose, Line& line) {
  const Eigen::Vector3d& p = pose.position_m;
  const Eigen::Quaterniond& q = pose.orientation;
  line << p.x() << p.y() << p.z() << q.x() << q.y() << q.z() << q.w();
}

void write_covariance(const Eigen::Matrix<double, 6, 6>& covariance, Line& line) {
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) line << covariance(row, column);
  }
}

void write_pose(const TickResult& result, Line& line) {
  if (!result.has_pose) return line.skip(kPoseColumns);
  write_place(result.pose, line);
  line << result.pose.rms_residual_m;
  write_covariance(result.pose.covariance, line);
}

void write_motion(const TickResult& result, Line& line) {
  if (result.has_pose) {
    line << result.false_lock_probability;
  } else {
    line.skip(1);
  }
  if (!result.filtered.motion.known) return line.skip(6);
  for (int i = 0; i < 3; ++i) line << result.filtered.motion.velocity_m_s[i];
  for (int i = 0; i < 3; ++i) line << result.filtered.motion.rates_rad_s[i];
}

// Of a camera that has been moved, what it sees is given, too: its repair rests on it.
void write_view(const core::DotView& view, bool moved, Line& line) {
  if (!view.used && !(moved && view.seen)) return line.skip(5);
  line << view.pixel.x() << view.pixel.y() << view.residual_px << view.normalised_residual
       << core::to_string(view.flaw);
}

void write_dot(const TickResult& result, std::size_t i, std::size_t cameras, Line& line) {
  const core::DotState& dot = result.dots[i];
  line << dot.located;
  if (dot.located) {
    line << dot.position_m.x() << dot.position_m.y() << dot.position_m.z() << dot.position_sigma_m;
  } else {
    line.skip(4);
  }
  for (std::size_t camera = 0; camera < cameras; ++camera) {
    write_view(dot.views[camera], result.cameras[camera].moved, line);
  }
}

// Without light control nobody knows what the cameras are set to.
void write_light(const CycleRecord& record, std::size_t camera, Line& line) {
  const exposure::CameraLight& light = record.light[camera];
  line << record.result.cameras[camera].bloomed << light.peak_dn << light.saturated_px
       << exposure::to_string(light.state) << exposure::to_string(light.iris);
  if (light.state == exposure::LightState::off) return line.skip(3);
  line << 1e3 * to_seconds(light.setting.exposure) << light.setting.gain << light.opening;
}

using CountColumn = std::pair<std::string_view, std::uint64_t>;

std::array<CountColumn, 14> count_columns(const AcquisitionCounts& counts) {
  return {{{"pairs_tested", counts.pairs_tested},
           {"rejected_collinear", counts.rejected_collinear},
           {"rejected_behind", counts.rejected_behind},
           {"rejected_distance", counts.rejected_distance},
           {"rejected_miss", counts.rejected_miss},
           {"rejected_size", counts.rejected_size},
           {"rejected_reprojection", counts.rejected_reprojection},
           {"pairs_accepted", counts.pairs_accepted},
           {"finalists", counts.finalists},
           {"acquisition_overflow", counts.overflow},
           {"work_units", counts.work_units},
           {"acquisition_ticks", counts.ticks},
           {"min_views", counts.min_views},
           {"dots_matched", counts.dots_matched}}};
}

void header_of_covariance(std::string_view name, Line& line) {
  for (std::size_t row = 0; row < kAxes.size(); ++row) {
    for (std::size_t column = row; column < kAxes.size(); ++column) {
      line << fmt::format("{}_{}_{}", name, kAxes[row], kAxes[column]);
    }
  }
}

void header_of_pose(Line& line) {
  for (const std::string_view name :
       {"x_m", "y_m", "z_m", "qx", "qy", "qz", "qw", "rms_residual_m"}) {
    line << name;
  }
  header_of_covariance("cov", line);
}

void header_of_dot(std::size_t dot, const std::vector<std::string>& cameras, Line& line) {
  for (const std::string_view name : {"located", "x_m", "y_m", "z_m", "sigma_m"}) {
    line << fmt::format("dot{}_{}", dot, name);
  }
  for (const std::string& camera : cameras) {
    for (const std::string_view name : {"x_px", "y_px", "residual_px", "normalised", "flaw"}) {
      line << fmt::format("dot{}_{}_{}", dot, camera, name);
    }
  }
}

void write_filtered(const core::FilteredPose& filtered, Line& line) {
  if (!filtered.known) {
    line << "none";
    return line.skip(kFilteredColumns);
  }
  line << (filtered.coasting ? "coasting" : "filtered");
  write_place(filtered.pose, line);
  write_covariance(filtered.pose.covariance, line);
  if (!filtered.motion.known) return line.skip(kAxes.size());
  for (int i = 0; i < 6; ++i) line << std::sqrt(filtered.motion_covariance(i, i));
}

// Where the filter is, what the camera models leave open, and how many views there were.
void write_estimation(const TickResult& result, Line& line) {
  write_filtered(result.filtered, line);
  if (result.has_pose) {
    for (int i = 0; i < 6; ++i) line << std::sqrt(result.systematic(i, i));
    line << result.dot_sigma_m;
  } else {
    line.skip(kAxes.size() + 1);
  }
  line << result.views_used << result.views_left_out;
}

void header_of_estimation(Line& line) {
  line << "filter";
  for (const std::string_view name : {"x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"}) {
    line << fmt::format("filtered_{}", name);
  }
  header_of_covariance("filtered_cov", line);
  for (const std::string_view name :
       {"vx_m_s", "vy_m_s", "vz_m_s", "wx_rad_s", "wy_rad_s", "wz_rad_s"}) {
    line << fmt::format("sigma_{}", name);
  }
  for (const std::string_view axis : kAxes) line << fmt::format("systematic_{}", axis);
  line << "dot_sigma_m"
       << "views_used"
       << "views_left_out";
}

std::string header(const std::vector<std::string>& cameras, std::size_t dots) {
  std::string text;
  Line line(text);
  for (const std::string_view name : {"tick", "t_s", "state", "reason", "reset_count", "relock",
                                      "ticks_lost", "cameras_used", "dots_used"}) {
    line << name;
  }
  header_of_pose(line);
  for (std::size_t dot = 0; dot < dots; ++dot) header_of_dot(dot, cameras, line);
  for (const std::string& camera : cameras) {
    for (const std::string_view name :
         {"delivered",     "used",           "regions",        "components",
          "rejected_size", "rejected_shape", "rejected_sight", "sightings",
          "overflow",      "stale",          "moved",          "shift_x_px",
          "shift_y_px",    "bloomed",        "peak_dn",        "saturated_px",
          "light",         "iris_condition", "exposure_ms",    "gain",
          "iris"}) {
      line << fmt::format("{}_{}", camera, name);
    }
  }
  for (const auto& [name, value] : count_columns({})) line << name;
  for (const std::string_view name :
       {"candidate_false_lock_probability", "false_lock_probability", "vx_m_s", "vy_m_s", "vz_m_s",
        "wx_rad_s", "wy_rad_s", "wz_rad_s", "rig_disagrees"}) {
    line << name;
  }
  header_of_estimation(line);
  line.end();
  return text;
}

}  // namespace

CsvWriter::CsvWriter(OutputFile& file, std::vector<std::string> cameras, std::size_t dots)
    : file_(file), cameras_(std::move(cameras)), dots_(dots) {
  file_.write(header(cameras_, dots_));
}

void CsvWriter::do_write(const CycleRecord& record) {
  const TickResult& result = record.result;
  Line line(line_);
  write_time(record, line);
  line << core::to_string(result.state) << core::to_string(result.reason) << result.reset_count
       << word_of(result.relock) << result.ticks_lost << result.cameras_used.size()
       << result.dots_used;
  write_pose(result, line);
  for (std::size_t dot = 0; dot < dots_; ++dot) {
    write_dot(result, dot, cameras_.size(), line);
  }
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const core::CameraTick& camera = result.cameras[i];
    line << camera.delivered << camera.used << camera.regions << camera.components
         << camera.rejected_size << camera.rejected_shape << camera.rejected_sight
         << camera.sightings << camera.overflow << camera.stale << camera.moved
         << camera.shift_px.x() << camera.shift_px.y();
    write_light(record, i, line);
  }
  for (const auto& [name, value] : count_columns(result.acquisition)) line << value;
  line << result.acquisition.false_lock_probability;
  write_motion(result, line);
  line << result.rig_disagrees;
  write_estimation(result, line);
  line.end();
  file_.write(line_);
}

}  // namespace dottrack::telemetry
