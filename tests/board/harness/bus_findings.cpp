// What the unit says on CAN besides where the vehicle is: whole frames, their age, how sure it is,
// and what it is.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/board/harness/findings.h"

namespace dottrack::board {
namespace {

constexpr unsigned kCovarianceUnknown = 11;  // bit of `degraded`
constexpr double kPeriodTolerance = 0.01;    // of the period that the rig file asks for

std::vector<ReceivedPose> poses_from(const Board& board, std::size_t first) {
  std::vector<ReceivedPose> poses = board.poses().from(first);
  std::erase_if(poses, [](const ReceivedPose& pose) { return !is_pose(pose); });
  return poses;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Finding verdicts(const Board& board) {
  const dottrack_counts counts = board.poses().counts();
  const auto wrong = counts.corrupted + counts.repeated_frames + counts.repeated_groups +
                     counts.other_version + counts.restarts;
  return {"verdicts of the receiver", wrong == 0 && counts.frames > 0,
          fmt::format("{} frames: {} groups fresh, {} stale, {} incomplete, {} lost; {} corrupted, "
                      "{} frames and {} groups repeated, {} late",
                      counts.frames, counts.fresh, counts.stale, counts.incomplete,
                      counts.lost_groups, counts.corrupted, counts.repeated_frames,
                      counts.repeated_groups, counts.late_frames)};
}

Finding ages(const std::vector<ReceivedPose>& poses) {
  std::vector<double> ages_ms;
  std::size_t fresh = 0;
  for (const ReceivedPose& pose : poses) {
    ages_ms.push_back(pose.message.age_us / 1e3);
    fresh += pose.fresh ? 1 : 0;
  }
  const double oldest = ages_ms.empty() ? 0.0 : *std::max_element(ages_ms.begin(), ages_ms.end());
  return {"age of poses on arrival", fresh > 0 && fresh == poses.size(),
          fmt::format("{:.0f} ms in the middle, {:.0f} ms at most; {} of {} fresh", median(ages_ms),
                      oldest, fresh, poses.size())};
}

// Along the diagonal; the frames are those of the world.
double trace(const dottrack_pose& pose, std::size_t first) {
  double sum = 0.0;
  for (std::size_t i = first; i < first + 3; ++i) sum += pose.covariance[7 * i];
  return sum;
}

Finding covariances(const std::vector<ReceivedPose>& poses) {
  std::vector<double> position_mm;
  std::vector<double> attitude_mrad;
  std::size_t unexplained = 0;
  for (const ReceivedPose& pose : poses) {
    if (pose.message.has_covariance) {
      position_mm.push_back(std::sqrt(trace(pose.message, 0)) * 1e3);
      attitude_mrad.push_back(std::sqrt(trace(pose.message, 3)) * 1e3);
    } else if ((pose.message.degraded >> kCovarianceUnknown & 1) == 0) {
      ++unexplained;
    }
  }
  return {
      "covariance", unexplained == 0 && !position_mm.empty(),
      fmt::format("with {} of {} poses; sigma {:.1f} mm and {:.2f} mrad in the middle",
                  position_mm.size(), poses.size(), median(position_mm), median(attitude_mrad))};
}

Finding identity(Board& board) {
  const dottrack_unit unit = board.poses().unit();
  const double period_s = unit.group_period_us / 1e6;
  const double expected_s = 1.0 / board.scene().frame_rate_hz;
  const bool holds = unit.has_version && unit.has_configuration &&
                     unit.cameras == board.scene().cameras.size() &&
                     std::abs(period_s / expected_s - 1.0) <= kPeriodTolerance;
  return {"version and configuration on CAN", holds,
          fmt::format("protocol {}, software {}.{}.{}, a group every {:.4f} s, {} cameras, "
                      "configuration {:08X}",
                      unit.protocol, unit.major, unit.minor, unit.patch, period_s, unit.cameras,
                      unit.config_hash)};
}

}  // namespace

std::vector<Finding> bus_findings(Board& board, std::size_t first) {
  const auto poses = poses_from(board, first);
  return {verdicts(board), ages(poses), covariances(poses), identity(board)};
}

}  // namespace dottrack::board
