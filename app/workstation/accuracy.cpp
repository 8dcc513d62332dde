#include "app/workstation/accuracy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dottrack::workstation {
namespace {

constexpr double kSameTime_s = 1e-3;

void add(const TimedPose& pose, const TimedPose& truth, Accuracy& sum) {
  const double off_mm = 1000.0 * (pose.position_m - truth.position_m).norm();
  const double off_deg =
      180.0 / std::numbers::pi * pose.orientation.angularDistance(truth.orientation);
  ++sum.compared;
  if (off_mm > kWrongLock_mm || off_deg > kWrongLock_deg) ++sum.wrong_lock_ticks;
  sum.position_rms_mm += off_mm * off_mm;
  sum.attitude_rms_deg += off_deg * off_deg;
  sum.position_max_mm = std::max(sum.position_max_mm, off_mm);
  sum.attitude_max_deg = std::max(sum.attitude_max_deg, off_deg);
}

}  // namespace

Accuracy compare(std::span<const TimedPose> poses, std::span<const TimedPose> truth) {
  Accuracy result;
  auto candidate = truth.begin();
  for (const TimedPose& pose : poses) {
    while (candidate != truth.end() && candidate->time_s < pose.time_s - kSameTime_s) ++candidate;
    if (candidate == truth.end() || candidate->time_s > pose.time_s + kSameTime_s) {
      ++result.without_truth;
    } else {
      add(pose, *candidate, result);
    }
  }
  if (result.compared == 0) return result;
  const auto count = static_cast<double>(result.compared);
  result.position_rms_mm = std::sqrt(result.position_rms_mm / count);
  result.attitude_rms_deg = std::sqrt(result.attitude_rms_deg / count);
  return result;
}

}  // namespace dottrack::workstation
