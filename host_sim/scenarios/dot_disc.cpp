#include "host_sim/scenarios/dot_disc.h"

#include <algorithm>

#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

constexpr double kLift_m = 0.002;  // off the face that a dot is painted on

}  // namespace

using Eigen::Vector3d;

Disc disc_of(const TargetDot& dot, const Pose& vehicle) {
  Disc disc;
  disc.normal = vehicle.rotation * dot.normal;
  disc.middle = vehicle.to_world(dot.centre_m) + kLift_m * disc.normal;
  const Vector3d u = disc.normal.unitOrthogonal();
  const Vector3d v = disc.normal.cross(u);
  for (int i = 0; i < kRimPoints; ++i) {
    const double angle = 2.0 * kPi * i / kRimPoints;
    disc.rim[static_cast<std::size_t>(i)] =
        disc.middle + 0.5 * dot.diameter_m * (cosine(angle) * u + sine(angle) * v);
  }
  return disc;
}

Obstacles::Obstacles(const Hall& hall, std::span<const MovingBody> bodies, double time_s)
    : hall_(hall) {
  for (const MovingBody& body : bodies) {
    if (const auto pose = (*body.motion)(time_s)) placed_.push_back({body.scene, *pose});
  }
}

bool Obstacles::hidden(const Vector3d& eye, const Vector3d& p) const {
  if (hall_.scene.blocked(eye, p)) return true;
  return std::any_of(placed_.begin(), placed_.end(), [&](const Placed& body) {
    return body.scene->blocked(body.pose.to_body(eye), body.pose.to_body(p));
  });
}

}  // namespace dottrack::host_sim
