#include "app/workstation/tum_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

namespace dottrack::workstation {
namespace {

bool parse(const std::string& line, TimedPose& pose) {
  std::istringstream in(line);
  in.imbue(std::locale::classic());
  Eigen::Vector3d& p = pose.position_m;
  Eigen::Quaterniond& q = pose.orientation;
  in >> pose.time_s >> p.x() >> p.y() >> p.z() >> q.x() >> q.y() >> q.z() >> q.w();
  std::string rest;
  if (!in || (in >> rest)) return false;
  return std::isfinite(pose.time_s) && p.allFinite() && std::abs(q.norm() - 1.0) < 1e-3;
}

}  // namespace

Result<std::vector<TimedPose>> read_tum(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return fail(fmt::format("{}: cannot read it; expected a TUM file", file.string()));
  std::vector<TimedPose> poses;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    TimedPose pose;
    const bool later = parse(line, pose) && (poses.empty() || pose.time_s > poses.back().time_s);
    if (!later) {
      return fail(
          fmt::format("{}:{}: expected t x y z qx qy qz qw with a unit quaternion and a "
                      "later time than before",
                      file.string(), number));
    }
    pose.orientation.normalize();
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace dottrack::workstation
