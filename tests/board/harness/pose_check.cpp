#include "tests/board/harness/pose_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "tests/board/harness/exposure_matching.h"

namespace dottrack::board {
namespace {

constexpr double kReach_periods = 0.45;  // of a stamp from its exposure: further is ambiguous

}  // namespace

std::string PoseCheck::figures() const {
  std::string text = fmt::format("{} poses off by up to {:.0f} mm and {:.2f} deg", truth.poses(),
                                 truth.position_max_m() * 1e3, truth.attitude_max_deg());
  if (truth.wrong() > 0) text += fmt::format(", {} WRONG", truth.wrong());
  if (unmatched > 0) text += fmt::format(", {} of no exposure", unmatched);
  return text;
}

PoseCheck check_poses(Board& board, std::size_t first) {
  PoseCheck check;
  const auto barriers = board.cameras().barriers();
  const Duration exposure = board.cameras().exposure(0).exposure;
  const auto reach = std::chrono::duration_cast<Duration>(
      std::chrono::duration<double>(kReach_periods / board.scene().frame_rate_hz));
  for (const ReceivedPose& pose : board.poses().from(first)) {
    if (!is_pose(pose)) continue;
    const Time stamp = board.to_host(pose.boot, mid_exposure(pose));
    const auto match = match_exposure(stamp, barriers, exposure, reach);
    const auto true_pose =
        match ? host_sim::truth(board.scene(), match->barrier.scene_time_s) : std::nullopt;
    if (!true_pose) {
      ++check.unmatched;
      continue;
    }
    check.late_ms.push_back(to_seconds(match->late) * 1e3);
    check.truth.add({position_m(pose), orientation(pose)},
                    {true_pose->position_m, true_pose->orientation()});
  }
  std::sort(check.late_ms.begin(), check.late_ms.end());
  return check;
}

Result<std::size_t> await_poses(Board& board, std::size_t first, std::size_t count,
                                Duration patience) {
  const auto last = board.poses().wait_for(is_pose, count, first, patience);
  if (last) return *last + 1;
  const auto messages = board.poses().from(first);
  const auto poses = std::count_if(messages.begin(), messages.end(), is_pose);
  std::string text = fmt::format("{} of {} poses within {:.0f} s, {} messages", poses, count,
                                 to_seconds(patience), messages.size());
  if (!messages.empty()) {
    text += fmt::format(", the last with reason {}",
                        dottrack_reason_text(messages.back().message.reason));
  }
  return fail(text);
}

}  // namespace dottrack::board
