#include "host_sim/world/terrain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host_sim/world/noise.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;

constexpr double kDune_m = 0.092;  // amplitudes and sizes
constexpr double kDuneSize_m = 1.9;
constexpr double kHollow_m = 0.020;
constexpr double kHollowSize_m = 1.0;
constexpr double kAtBoards_m = 0.9;  // over which the sand flattens towards the boards
constexpr double kAtRamp_m = 1.2;    // and towards a ramp
constexpr double kRampRounding_m = 0.2;
constexpr double kSlopeStep_m = 1e-4;

double ease(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

double beyond(double v, double low, double high) {
  return std::max({low - v, v - high, 0.0});
}

}  // namespace

Terrain::Terrain(double length_m, double width_m, std::uint64_t seed, std::optional<Ramp> ramp)
    : half_length_m_(0.5 * length_m),
      half_width_m_(0.5 * width_m),
      seed_(seed),
      ramp_(std::move(ramp)) {
  if (ramp_) ramp_forward_ = {cosine(ramp_->heading_rad), sine(ramp_->heading_rad)};
}

bool Terrain::is_sand(const Vector2d& p) const {
  return std::abs(p.x()) <= half_length_m_ && std::abs(p.y()) <= half_width_m_;
}

Vector2d Terrain::in_ramp(const Vector2d& p) const {
  const Vector2d from_foot = p - ramp_->foot_m;
  return {from_foot.dot(ramp_forward_),
          from_foot.y() * ramp_forward_.x() - from_foot.x() * ramp_forward_.y()};
}

// Share of the dunes that is left at a point.
double Terrain::flattening(const Vector2d& p) const {
  const double to_boards =
      std::min(half_length_m_ - std::abs(p.x()), half_width_m_ - std::abs(p.y()));
  const double left = ease(to_boards / kAtBoards_m);
  if (!ramp_) return left;
  const Vector2d q = in_ramp(p);
  const double reach_m = ramp_->length_m * cosine(ramp_->angle_rad);
  const Vector2d off(beyond(q.x(), -kRampRounding_m, reach_m),
                     beyond(q.y(), -0.5 * ramp_->width_m, 0.5 * ramp_->width_m));
  return left * ease(off.norm() / kAtRamp_m);
}

double Terrain::sand_height_m(const Vector2d& p) const {
  if (!is_sand(p)) return 0.0;
  const double dunes = kDune_m * value_noise(Vector2d(p / kDuneSize_m), seed_ + 41);
  const double hollows = kHollow_m * value_noise(Vector2d(p / kHollowSize_m), seed_ + 42);
  return flattening(p) * (dunes + hollows);
}

double Terrain::ramp_height_m(double along_m) const {
  if (along_m < -kRampRounding_m) return 0.0;
  const double slope = tangent(ramp_->angle_rad);
  if (along_m > kRampRounding_m) return slope * along_m;
  const double into = along_m + kRampRounding_m;
  return slope * into * into / (4.0 * kRampRounding_m);
}

double Terrain::height_m(const Vector2d& p) const {
  const double sand = sand_height_m(p);
  if (!ramp_) return sand;
  const Vector2d q = in_ramp(p);
  const bool on_it = std::abs(q.y()) <= 0.5 * ramp_->width_m &&
                     q.x() <= ramp_->length_m * cosine(ramp_->angle_rad);
  return on_it ? std::max(sand, ramp_height_m(q.x())) : sand;
}

Eigen::Vector3d Terrain::normal(const Vector2d& p) const {
  const Vector2d dx(kSlopeStep_m, 0.0);
  const Vector2d dy(0.0, kSlopeStep_m);
  return Eigen::Vector3d(height_m(p - dx) - height_m(p + dx), height_m(p - dy) - height_m(p + dy),
                         2.0 * kSlopeStep_m)
      .normalized();
}

}  // namespace dottrack::host_sim
