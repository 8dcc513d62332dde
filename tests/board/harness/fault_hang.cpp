#include <fmt/format.h>

#include "tests/board/harness/fault_steps.h"
#include "tests/board/harness/host_clock.h"
#include "tests/board/harness/wiring.h"

namespace dottrack::board {
namespace {

using std::chrono::seconds;

constexpr auto kResetPatience = seconds(120);
constexpr auto kReturnPatience = seconds(300);

Result<std::string> stop_and_wait(Board& board) {
  const std::size_t resets = board.emulator().resets();
  const std::size_t bites = board.emulator().watchdog_bites();
  const std::uint64_t restarts = board.poses().counts().restarts;
  const auto stopped = board.shell().check(
      "kill -STOP \"$(systemctl show -p MainPID --value dottrackd.service)\"", kCommandPatience);
  if (!stopped) return stopped;
  const Time stopped_at = host_now();
  if (!board.emulator().wait_for_reset(resets, kResetPatience)) {
    return fail(fmt::format("no reset within {} s", kResetPatience.count()));
  }
  const Time reset_at = host_now();
  board.note_reset();
  if (board.emulator().watchdog_bites() == bites) return fail("a reset, but not by the watchdog");
  if (auto ready = board.set_up_guest(); !ready) return tl::unexpected(ready.error());
  const std::size_t first = board.poses().size();
  const auto tracking = await_poses(board, first, 1, kReturnPatience);
  if (!tracking) return fail("after the reset: " + tracking.error().message);
  const double back_s =
      seconds_between(reset_at, board.poses().from(*tracking - 1).front().received);
  const auto on = await_poses(board, first, kPosesToGoOn, kPosePatience);
  if (!on) return fail("after the reset: " + on.error().message);
  if (board.poses().counts().restarts != restarts + 1) {
    return fail("the receiver did not notice that the unit's clock began anew");
  }
  return with_right_poses(board, first,
                          fmt::format("reset after {:.1f} s, tracking {:.1f} s later by itself",
                                      seconds_between(stopped_at, reset_at), back_s));
}

}  // namespace

Finding process_stopped(Board& board) {
  return conclude("process stopped (SIGSTOP)", stop_and_wait(board));
}

}  // namespace dottrack::board
