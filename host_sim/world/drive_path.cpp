#include "host_sim/world/drive_path.h"

#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

struct Turn {
  double cosine;
  double sine;

  Eigen::Vector2d operator()(const Eigen::Vector2d& v) const {
    return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
  }
};

Turn turn_by(double angle_rad) {
  return {cosine(angle_rad), sine(angle_rad)};
}

Eigen::Vector2d on_curve(const DrivePath& p, double phase) {
  return {p.radius_x_m * cosine(phase),
          p.radius_y_m * sine(phase) + p.wobble_m * sine(2.0 * phase)};
}

Eigen::Vector2d along_curve(const DrivePath& p, double phase) {
  const Eigen::Vector2d tangent(
      -p.radius_x_m * sine(phase),
      p.radius_y_m * cosine(phase) + 2.0 * p.wobble_m * cosine(2.0 * phase));
  return tangent.normalized();
}

// Heading first, then nose up or down, then roll: Rz Ry Rx.
Eigen::Matrix3d attitude(const Eigen::Vector2d& forward, double pitch_rad, double roll_rad) {
  Eigen::Matrix3d yaw;
  yaw << forward.x(), -forward.y(), 0.0, forward.y(), forward.x(), 0.0, 0.0, 0.0, 1.0;
  const Turn p = turn_by(pitch_rad);
  const Turn r = turn_by(roll_rad);
  Eigen::Matrix3d pitch;
  pitch << p.cosine, 0.0, p.sine, 0.0, 1.0, 0.0, -p.sine, 0.0, p.cosine;
  Eigen::Matrix3d roll;
  roll << 1.0, 0.0, 0.0, 0.0, r.cosine, -r.sine, 0.0, r.sine, r.cosine;
  return yaw * pitch * roll;
}

}  // namespace

Pose pose_at(const DrivePath& path, double time_s) {
  const double phase = path.phase_rad + path.rate_rad_s * time_s;
  const Turn turn{path.x_axis.x(), path.x_axis.y()};
  const Eigen::Vector2d xy = path.centre_m + turn(on_curve(path, phase));
  const double pitch = path.pitch_rad * sine(1.9 * time_s + 0.4);
  const double roll = path.roll_rad * sine(1.3 * time_s + 1.1);
  return {{xy.x(), xy.y(), path.heave_m * sine(1.6 * time_s)},
          attitude(turn(along_curve(path, phase)), pitch, roll)};
}

DrivePath starting_at(DrivePath path, const Eigen::Vector2d& position_m, double yaw_rad) {
  const Eigen::Vector2d tangent = along_curve(path, path.phase_rad);
  const Turn wanted = turn_by(yaw_rad);
  const Turn turn{wanted.cosine * tangent.x() + wanted.sine * tangent.y(),
                  wanted.sine * tangent.x() - wanted.cosine * tangent.y()};
  path.x_axis = Eigen::Vector2d(turn.cosine, turn.sine).normalized();
  path.centre_m = position_m - turn(on_curve(path, path.phase_rad));
  return path;
}

}  // namespace dottrack::host_sim
