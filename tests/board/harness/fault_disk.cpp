#include <fmt/format.h>

#include "tests/board/harness/fault_steps.h"
#include "tests/board/harness/wiring.h"

namespace dottrack::board {
namespace {

using std::chrono::seconds;

constexpr auto kFillPatience = seconds(180);

std::string fill() {
  return fmt::format(
      "cd {0} && fallocate -l \"$(df --output=avail -B1 . | tail -n 1)\" fill && "
      "df --output=avail -BM . | tail -n 1",
      kRecordingFolder);
}

Result<std::string> fill_and_free(Board& board) {
  const auto process = board.service("MainPID");
  if (!process) return process;
  const std::size_t journal = board.journal().size();
  const std::size_t first = board.poses().size();
  const auto filled = board.shell().check(fill(), kFillPatience);
  if (!filled) return filled;
  auto told = await_journal(board, journal, {"dottrackd", "not recording"}, seconds(60));
  auto status = told ? await_status(board, "ticks lost", true, seconds(30)) : told;
  const auto on = await_poses(board, board.poses().size(), kPosesToGoOn, kPosePatience);
  const auto emptied =
      board.shell().check(fmt::format("rm -f {}/fill", kRecordingFolder), kFillPatience);
  if (!status) return status;
  if (!emptied) return emptied;
  if (!on) return fail("with the disk full: " + on.error().message);
  const auto again = await_journal(board, journal, {"dottrackd", "recording again"}, seconds(60));
  if (!again) return again;
  if (auto same = still_process(board, *process); !same) return tl::unexpected(same.error());
  const auto words = again->find("recording again");
  return with_right_poses(board, first, "poses go on, the loss is told: " + again->substr(words));
}

}  // namespace

Finding recording_disk_full(Board& board) {
  return conclude("recording disk full", fill_and_free(board));
}

}  // namespace dottrack::board
