#include <fmt/format.h>

#include <thread>

#include "tests/board/harness/fault_steps.h"
#include "tests/board/harness/host_clock.h"

namespace dottrack::board {
namespace {

using std::chrono::seconds;

constexpr auto kOutage = seconds(6);

Result<std::string> take_down_and_up(Board& board) {
  const auto process = board.service("MainPID");
  if (!process) return process;
  if (auto down = board.shell().check("ip link set can0 down", kCommandPatience); !down) {
    return down;
  }
  std::this_thread::sleep_for(seconds(1));  // for what was on its way
  const std::size_t first = board.poses().size();
  std::this_thread::sleep_for(kOutage);
  const std::size_t meanwhile = board.poses().size() - first;
  if (auto up = board.shell().check("ip link set can0 up", kCommandPatience); !up) return up;
  if (meanwhile > 0) return fail(fmt::format("{} messages while the bus was down", meanwhile));
  const Time up_at = host_now();
  const auto last = await_poses(board, first, kPosesToGoOn, kPosePatience);
  if (!last) return fail("the bus is up again: " + last.error().message);
  const double took_s = seconds_between(up_at, board.poses().from(first).front().received);
  if (auto same = still_process(board, *process); !same) return tl::unexpected(same.error());
  return with_right_poses(
      board, first,
      fmt::format("silent for {} s, poses {:.1f} s after it was up", kOutage.count() + 1, took_s));
}

}  // namespace

Finding can_bus_down(Board& board) {
  return conclude("CAN bus down and up", take_down_and_up(board));
}

}  // namespace dottrack::board
