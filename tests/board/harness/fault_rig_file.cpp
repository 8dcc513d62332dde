#include <fmt/format.h>

#include "tests/board/harness/fault_steps.h"
#include "tests/board/harness/rig_edits.h"

namespace dottrack::board {
namespace {

using std::chrono::seconds;

constexpr auto kReopenPatience = seconds(120);

constexpr const char* kBreak = R"(s/^frame_rate_hz.*/frame_rate_hz = "often"/)";
constexpr const char* kExpose = "s/^exposure_ms = .*/exposure_ms = 3.2/";
constexpr Duration kExposure = std::chrono::microseconds(3200);
Result<std::string> break_and_repair(Board& board) {
  const auto process = board.service("MainPID");
  if (!process) return process;
  const std::size_t journal = board.journal().size();
  const std::size_t first = board.poses().size();
  if (auto done = edit_rig(board, kBreak); !done) return tl::unexpected(done.error());
  auto reason = await_journal(board, journal, {"rig.toml:3", "frame_rate_hz", "stays as it was"},
                              seconds(30));
  const auto on = await_poses(board, first, kPosesToGoOn, kPosePatience);
  const std::size_t repaired = board.journal().size();
  if (auto done = restore_rig(board); !done) return tl::unexpected(done.error());
  if (!reason) return reason;
  if (!on) return fail("with the broken file: " + on.error().message);
  if (auto taken = await_journal(board, repaired, {"configuration is in force"}, seconds(60));
      !taken) {
    return taken;
  }
  const auto after = await_poses(board, board.poses().size(), kPosesToGoOn, kPosePatience);
  if (!after) return fail("with the repaired file: " + after.error().message);
  if (auto same = still_process(board, *process); !same) return tl::unexpected(same.error());
  return with_right_poses(board, first, "old one kept, reason logged; repaired one taken");
}

// The cameras are closed and opened again with what the file says now, in the same process.
Result<std::string> change_and_restore(Board& board) {
  const auto process = board.service("MainPID");
  if (!process) return process;
  const std::size_t journal = board.journal().size();
  const std::size_t first = board.poses().size();
  if (auto done = edit_rig(board, kExpose); !done) {
    return tl::unexpected(done.error());
  }
  const auto opened = await_journal(board, journal, {"devices opened anew"}, kReopenPatience);
  const auto on = await_poses(board, board.poses().size(), kPosesToGoOn, kPosePatience);
  const Duration set = board.cameras().exposure(0).exposure;
  const std::size_t restored = board.journal().size();
  if (auto done = restore_rig(board); !done) return tl::unexpected(done.error());
  if (!opened) return opened;
  if (!on) return fail("with the other exposure: " + on.error().message);
  if (set != kExposure) {
    return fail(fmt::format("the cameras expose {} us; expected {}", set.count() / 1000,
                            kExposure.count() / 1000));
  }
  auto again = await_journal(board, restored, {"devices opened anew"}, kReopenPatience);
  if (!again) return again;
  const auto after = await_poses(board, board.poses().size(), kPosesToGoOn, kPosePatience);
  if (!after) return fail("with the first exposure again: " + after.error().message);
  if (auto same = still_process(board, *process); !same) return tl::unexpected(same.error());
  return with_right_poses(board, first, "the cameras expose 3.2 ms, and then as before");
}

}  // namespace

Finding broken_rig_file(Board& board) {
  return conclude("broken rig.toml, SIGHUP", break_and_repair(board));
}

Finding other_exposure(Board& board) {
  return conclude("rig.toml with another exposure, SIGHUP", change_and_restore(board));
}

}  // namespace dottrack::board
