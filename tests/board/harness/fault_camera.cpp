#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tests/board/harness/fault_steps.h"
#include "tests/board/harness/host_clock.h"

namespace dottrack::board {
namespace {

using std::chrono::seconds;

// The camera that most of the last poses were made with.
std::size_t camera_in_use(const Board& board) {
  constexpr std::size_t kMessages = 30;
  std::array<int, kMaxCameras> uses{};
  const std::size_t size = board.poses().size();
  for (const ReceivedPose& pose : board.poses().from(size - std::min(size, kMessages))) {
    for (std::size_t i = 0; i < kMaxCameras; ++i) {
      uses[i] += is_pose(pose) && rests_on(pose, i) ? 1 : 0;
    }
  }
  return static_cast<std::size_t>(std::max_element(uses.begin(), uses.end()) - uses.begin());
}

Result<std::string> unplug_and_plug_in(Board& board, std::size_t camera) {
  const std::string name = board.scene().cameras[camera].name;
  const auto process = board.service("MainPID");
  if (!process) return process;
  const std::size_t journal = board.journal().size();
  const std::size_t first = board.poses().size();
  board.cameras().unplug(camera);
  const auto without = [&](const ReceivedPose& pose) {
    return is_pose(pose) && !rests_on(pose, camera);
  };
  const auto gone = board.poses().wait_for(without, kPosesToGoOn, first, kPosePatience);
  if (!gone) return fail(fmt::format("{} unplugged: no poses without it", name));
  if (auto told =
          await_journal(board, journal, {"dottrackd", name, "delivers no images"}, seconds(30));
      !told) {
    return told;
  }
  if (auto told = await_status(board, name, true, seconds(30)); !told) return told;

  const std::size_t back = board.poses().size();
  const Time plugged_in = host_now();
  board.cameras().plug_in(camera);
  const auto with = [&](const ReceivedPose& pose) {
    return is_pose(pose) && rests_on(pose, camera);
  };
  const auto used = board.poses().wait_for(with, 3, back, kPosePatience);
  if (!used) return fail(fmt::format("{} plugged in again: no poses with it", name));
  const double took_s = seconds_between(plugged_in, board.poses().from(*used).front().received);
  if (auto told = await_status(board, name, false, seconds(30)); !told) return told;
  if (auto same = still_process(board, *process); !same) return tl::unexpected(same.error());
  return with_right_poses(
      board, first,
      fmt::format("{} left, status and journal name it; in use again after {:.1f} s", name,
                  took_s));
}

}  // namespace

Finding camera_unplugged(Board& board) {
  return conclude("camera unplugged, plugged in", unplug_and_plug_in(board, camera_in_use(board)));
}

}  // namespace dottrack::board
