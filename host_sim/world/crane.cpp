// What hangs from a crane.

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "host_sim/world/meshes.h"
#include "host_sim/world/motions.h"
#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kGravity_m_s2 = 9.81;

struct Swing {
  double frequency_hz;
  Vector2d amplitude;  // in vibrations, along x and y
  Vector2d phase_rad;
};
constexpr double kQuarter = 0.5 * kPi;
const std::array<Swing, 2> kSwings = {
    {{0.7, {1.0, 0.6}, {0.0, kQuarter}}, {1.3, {0.2, 0.35}, {1.0, 0.4}}}};

struct Dangling {
  Vector2d offset_m = Vector2d::Zero();
  Vector2d tilt = Vector2d::Zero();  // offset over the length of the pendulum
};

Dangling dangling(double vibration_m, double time_s) {
  Dangling sum;
  for (const Swing& swing : kSwings) {
    const double omega = 2.0 * kPi * swing.frequency_hz;
    const double length_m = kGravity_m_s2 / (omega * omega);
    const Vector2d offset(
        vibration_m * swing.amplitude.x() * sine(omega * time_s + swing.phase_rad.x()),
        vibration_m * swing.amplitude.y() * sine(omega * time_s + swing.phase_rad.y()));
    sum.offset_m += offset;
    sum.tilt += offset / length_m;
  }
  return sum;
}

// The least rotation that takes z to `to` (unit, upwards).
Eigen::Matrix3d from_vertical(const Vector3d& to) {
  const Vector3d axis = Vector3d::UnitZ().cross(to);
  Eigen::Matrix3d k;
  k << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
  return Eigen::Matrix3d::Identity() + k + k * k / (1.0 + to.z());
}

double duration_s(const CraneLine& line) {
  return (line.to_m - line.from_m).norm() / line.speed_m_s;
}

Pose hanging(const CraneLine& line, double into_s, double time_s) {
  const double whole_s = duration_s(line);
  const double share = whole_s > 0.0 ? std::clamp(into_s / whole_s, 0.0, 1.0) : 0.0;
  const Dangling swing = dangling(line.vibration_m, time_s);
  Pose pose = upright(line.from_m + share * (line.to_m - line.from_m), line.yaw_rad);
  pose.position_m.head<2>() += swing.offset_m;
  const Vector3d up(-swing.tilt.x(), -swing.tilt.y(), 1.0);
  pose.rotation = from_vertical(up.normalized()) * pose.rotation;
  return pose;
}

}  // namespace

std::vector<LineTimes> crane_line_times(const std::vector<CraneLine>& lines) {
  std::vector<LineTimes> times;
  double from_s = 0.0;
  for (const CraneLine& line : lines) {
    times.push_back({from_s, from_s + duration_s(line)});
    from_s = times.back().to_s;
  }
  return times;
}

Motion crane_lines(std::vector<CraneLine> lines) {
  struct Run {
    std::vector<CraneLine> lines;
    std::vector<LineTimes> times;
  };
  auto times = crane_line_times(lines);
  const auto run = std::make_shared<const Run>(Run{std::move(lines), std::move(times)});
  return [run](double time_s) -> std::optional<Pose> {
    if (run->lines.empty()) return std::nullopt;
    std::size_t i = 0;
    while (i + 1 < run->lines.size() && time_s >= run->times[i].to_s) ++i;
    return hanging(run->lines[i], time_s - run->times[i].from_s, time_s);
  };
}

Motion crane_line(const Vector3d& from_m, const Vector3d& to_m, double speed_m_s, double yaw_rad,
                  double vibration_m) {
  return crane_lines({{from_m, to_m, speed_m_s, yaw_rad, vibration_m}});
}

}  // namespace dottrack::host_sim
