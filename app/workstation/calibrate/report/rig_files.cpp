#include "app/workstation/calibrate/report/rig_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "app/config/camera_file.h"
#include "app/config/joint_covariance.h"

namespace dottrack::calibrate {
namespace {

constexpr double kNearer = 0.5;    // of the nearest dot's distance: nothing comes closer
constexpr double kFarther = 1.25;  // of the farthest dot's distance
constexpr double kMost_m = 1000.0;

std::string extension(const geometry::CameraModel& model) {
  if (std::holds_alternative<geometry::Cahv>(model)) return ".cahv";
  return std::holds_alternative<geometry::Cahvor>(model) ? ".cahvor" : ".cahvore";
}

std::string comment_of(const CameraCalibration& c, const RigRequest& request) {
  if (!request.comment.empty()) return request.comment;
  return fmt::format("{}: {} from {} dots, RMS {:.3f} px, on dots left out {:.3f} px", c.name,
                     to_string(c.chosen), c.residuals.size(), c.rms_px, c.holdout_rms_px);
}

struct Reach {
  double nearest_m = 1e9;
  double farthest_m = 0.0;
};

Reach reach_of(const CameraCalibration& c, const Calibration& calibration) {
  Reach reach;
  for (const ResidualOfView& r : c.residuals) {
    if (!r.used) continue;
    const double distance = (calibration.dots[r.dot].position_m - geometry::centre(c.model)).norm();
    reach.nearest_m = std::min(reach.nearest_m, distance);
    reach.farthest_m = std::max(reach.farthest_m, distance);
  }
  return reach;
}

// Rounded outwards to three digits.
double rounded(double value, bool up) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  return unit * (up ? std::ceil(value / unit) : std::floor(value / unit));
}

std::string camera_table(const CameraCalibration& c, const Calibration& calibration,
                         const RigRequest& request) {
  const Reach reach = reach_of(c, calibration);
  const double farthest = std::min(rounded(kFarther * reach.farthest_m, true), kMost_m);
  std::string text = fmt::format(
      "\n[[camera]]\nname = \"{}\"\nmodel = \"{}{}\"\ndistance_m = [{:.6g}, {:.6g}]\n", c.name,
      c.name, extension(c.model), rounded(kNearer * reach.nearest_m, false), farthest);
  if (request.min_contrast_dn > 0.0) {
    text += fmt::format("min_contrast_dn = {:g}\n", request.min_contrast_dn);
  }
  if (request.min_contrast_part > 0.0) {
    text += fmt::format("min_contrast_part = {:g}\n", request.min_contrast_part);
  }
  return text;
}

config::JointCovariance joint_of(const Calibration& calibration) {
  config::JointCovariance joint;
  Eigen::Index first = 0;
  for (const CameraCalibration& c : calibration.cameras) {
    joint.cameras.push_back({c.name, first, c.covariance.rows()});
    first += c.covariance.rows();
  }
  joint.covariance = calibration.joint_covariance;
  return joint;
}

std::string quoted(const std::string& name) {
  std::string out;
  for (const char ch : name) {
    if (ch == '"' || ch == '\\') out += '\\';
    out += ch;
  }
  return out;
}

std::string target_table(const std::optional<std::filesystem::path>& target) {
  if (target) {
    return fmt::format("\n[target]\nname = \"{}\"\ndots = \"{}\"\n",
                       quoted(target->stem().string()), quoted(target->filename().string()));
  }
  return "\n# What is tracked: name the file with its dots in vehicle coordinates, and take the\n"
         "# comment signs away.\n# [target]\n# name = \"vehicle\"\n# dots = \"target.csv\"\n";
}

}  // namespace

Result<std::vector<RigFile>> rig_files(const Calibration& calibration, const RigRequest& request) {
  std::vector<RigFile> files;
  std::string rig =
      request.target ? "# Written by dottrack calibrate.\n"
                     : "# Written by dottrack calibrate. Not complete: it has no [target] yet.\n";
  rig += fmt::format("[rig]\nname = \"{}\"\njoint_covariance = \"{}\"\n", quoted(request.name),
                     config::kJointCovarianceFile);
  for (const CameraCalibration& c : calibration.cameras) {
    config::CameraFile file;
    file.model = c.model;
    file.dimensions = config::ImageSize{c.width_px, c.height_px};
    file.comment = comment_of(c, request);
    file.covariance = c.covariance;
    files.push_back({c.name + extension(c.model), config::write_camera_text(file)});
    rig += camera_table(c, calibration, request);
  }
  rig += target_table(request.target);
  files.push_back(
      {config::kJointCovarianceFile, config::write_joint_covariance(joint_of(calibration))});
  files.push_back({"rig.toml", rig});
  if (!request.target) return files;
  std::ifstream in(*request.target, std::ios::binary);
  if (!in) return fail(fmt::format("{}: cannot be read", request.target->string()));
  files.push_back(
      {request.target->filename().string(), std::string(std::istreambuf_iterator<char>(in), {})});
  return files;
}

}  // namespace dottrack::calibrate
