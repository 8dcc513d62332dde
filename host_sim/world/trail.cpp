#include "host_sim/world/trail.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

constexpr int kCentres = 200;
constexpr double kTread_m = 0.075;  // from one tread mark to the next
constexpr double kDepth = 0.16;     // how much darker the middle of a mark is
constexpr double kSoftEdge_m = 0.02;

double strip(double off_middle_m, double width_m) {
  return std::clamp((0.5 * width_m - off_middle_m) / kSoftEdge_m, 0.0, 1.0);
}

}  // namespace

Trail::Trail(const DrivePath& drive, double from_s, double to_s, double half_track_m,
             double width_m)
    : half_track_m_(half_track_m), width_m_(width_m) {
  double along_m = 0.0;
  for (int i = 0; i <= kCentres; ++i) {
    const double time_s = from_s + (to_s - from_s) * i / kCentres;
    const Eigen::Vector2d centre = pose_at(drive, time_s).position_m.head<2>();
    if (!centres_.empty()) along_m += (centre - centres_.back()).norm();
    centres_.push_back(centre);
    along_m_.push_back(along_m);
  }
}

double Trail::factor_at(const Eigen::Vector2d& p) const {
  if (centres_.empty()) return 1.0;
  double nearest2_m2 = std::numeric_limits<double>::infinity();
  double along_m = 0.0;
  for (std::size_t i = 1; i < centres_.size(); ++i) {
    const Eigen::Vector2d piece = centres_[i] - centres_[i - 1];
    const Eigen::Vector2d to_p = p - centres_[i - 1];
    const double t = std::clamp(to_p.dot(piece) / piece.squaredNorm(), 0.0, 1.0);
    const double distance2_m2 = (to_p - t * piece).squaredNorm();
    if (distance2_m2 >= nearest2_m2) continue;
    nearest2_m2 = distance2_m2;
    along_m = along_m_[i - 1] + t * piece.norm();
  }
  const double off_wheel_m = std::abs(std::sqrt(nearest2_m2) - half_track_m_);
  const double tread = 0.6 + 0.4 * sine(2.0 * kPi * along_m / kTread_m);
  return 1.0 - kDepth * tread * strip(off_wheel_m, width_m_);
}

}  // namespace dottrack::host_sim
