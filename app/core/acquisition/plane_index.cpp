#include "app/core/acquisition/plane_index.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dottrack::acquisition {

using Eigen::Vector3d;

PlanePencil::PlanePencil(const Vector3d& centre_a, const Vector3d& centre_b,
                         const Vector3d& scene) {
  const Vector3d baseline = centre_b - centre_a;
  const double length = baseline.norm();
  has_baseline_ = length > 0.0;
  if (!has_baseline_) return;
  const Vector3d axis = baseline / length;
  const Vector3d to_scene = scene - centre_a;
  const Vector3d across = to_scene - to_scene.dot(axis) * axis;
  across_ = across.norm() > 1e-9 * to_scene.norm() ? across.normalized() : axis.unitOrthogonal();
  up_ = axis.cross(across_);
}

double PlanePencil::angle(const Vector3d& direction) const {
  const double x = direction.dot(across_);
  const double y = direction.dot(up_);
  const double reach = std::abs(x) + std::abs(y);
  return reach > 0.0 ? std::copysign(1.0 - x / reach, y) : 0.0;
}

double PlanePencil::sine_to_baseline(const Vector3d& direction) const {
  return std::hypot(direction.dot(across_), direction.dot(up_));
}

int PlaneIndex::bucket(double angle) const {
  const double scaled = (angle - low_) * buckets_per_angle_;
  return static_cast<int>(std::clamp(scaled, 0.0, static_cast<double>(kBuckets - 1)));
}

void PlaneIndex::build(const PlanePencil& pencil, const estimation::Sightings& sightings) {
  size_ = sightings.size();
  double high = -2.0;
  low_ = 2.0;
  for (std::size_t i = 0; i < size_; ++i) {
    angle_[i] = pencil.angle(sightings[i].line.ray.direction);
    low_ = std::min(low_, angle_[i]);
    high = std::max(high, angle_[i]);
  }
  buckets_per_angle_ = kBuckets / std::max(high - low_, 1e-9);
  start_.fill(0);
  for (std::size_t i = 0; i < size_; ++i) {
    bucket_of_[i] = static_cast<std::uint16_t>(bucket(angle_[i]));
    ++start_[bucket_of_[i] + 1U];
  }
  for (std::size_t b = 0; b < kBuckets; ++b) {
    start_[b + 1] = static_cast<std::uint16_t>(start_[b + 1] + start_[b]);
  }
  std::array<std::uint16_t, kBuckets> next;
  std::copy_n(start_.begin(), kBuckets, next.begin());
  for (std::size_t i = 0; i < size_; ++i) {
    order_[next[bucket_of_[i]]++] = static_cast<std::uint16_t>(i);
  }
}

std::span<const std::uint16_t> PlaneIndex::near(double angle, double tolerance) const {
  const double from = angle - tolerance;
  const double to = angle + tolerance;
  // A window over the back of the pencil wraps round: rare, and then everything is near.
  if (from < -2.0 || to > 2.0) return {order_.data(), size_};
  if (size_ == 0 || to < low_) return {};
  const auto first = static_cast<std::size_t>(bucket(from));
  const auto last = static_cast<std::size_t>(bucket(to));
  return {order_.data() + start_[first], order_.data() + start_[last + 1]};
}

}  // namespace dottrack::acquisition
