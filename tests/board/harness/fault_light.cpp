#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "tests/board/harness/fault_steps.h"
#include "tests/board/harness/host_clock.h"
#include "tests/board/harness/rig_edits.h"

namespace dottrack::board {
namespace {

using std::chrono::seconds;

// The longest exposure leaves room for the rest of the period, and for a third of the light.
constexpr const char* kControl =
    R"(s/^\[loop\]/[light]\ncontrol = true\nexposure_ms = [0.1, 20.0]\nmax_blur_px = 5.0\n\n[loop]/)";
constexpr double kDimmed = 0.35;
constexpr double kFollowed =
    1.8;  // times as much light is gathered, at least; 1 / kDimmed makes up
constexpr double kBrightAgain = 0.6;
constexpr auto kRest = seconds(8);
constexpr auto kSettlePatience = seconds(90);

// What each camera was told to gather, and what its pictures show.
struct Light {
  std::vector<double> gathered_ms;  // exposure times gain times opening
  std::vector<double> mean_dn;
  std::uint64_t iris_steps = 0;
};

Light light_of(Board& board) {
  Light light;
  for (std::size_t i = 0; i < board.scene().cameras.size(); ++i) {
    const hal::ExposureSettings set = board.cameras().exposure(i);
    light.gathered_ms.push_back(1e3 * to_seconds(set.exposure) * set.gain *
                                board.gpio().iris(i).opening());
    light.mean_dn.push_back(board.lighting().mean_dn(i));
    light.iris_steps += board.gpio().iris(i).steps();
  }
  return light;
}

template <class Holds>
std::size_t cameras_where(const Light& light, Holds holds) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < light.mean_dn.size(); ++i) count += holds(i) ? 1U : 0U;
  return count;
}

// Camera i gathers more since the light went, and its pictures came up again.
bool followed(const Light& before, const Light& now, std::size_t i) {
  return now.gathered_ms[i] > kFollowed * before.gathered_ms[i] &&
         now.mean_dn[i] > kBrightAgain * before.mean_dn[i];
}

std::string words(const Light& before, const Light& now) {
  std::string text;
  for (std::size_t i = 0; i < before.mean_dn.size(); ++i) {
    text += fmt::format("{}cam{} gathers {:.1f} times as much for {:.0f} % of the brightness",
                        i == 0 ? "" : ", ", i + 1, now.gathered_ms[i] / before.gathered_ms[i],
                        1e2 * now.mean_dn[i] / before.mean_dn[i]);
  }
  return text;
}

// Until no camera is told anything else for a while.
Light await_rest(Board& board) {
  const Time deadline = host_now() + kSettlePatience;
  Light light = light_of(board);
  Time since = host_now();
  while (host_now() < deadline && host_now() - since < kRest) {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    Light now = light_of(board);
    if (now.gathered_ms != light.gathered_ms) since = host_now();
    light = std::move(now);
  }
  return light;
}

// Three in four: some cameras may see no dot where the rover is.
Result<std::size_t> await_followers(Board& board, const Light& before) {
  const std::size_t enough = (3 * before.mean_dn.size() + 3) / 4;
  const Time deadline = host_now() + kSettlePatience;
  Light now = light_of(board);
  while (host_now() < deadline) {
    const auto followers =
        cameras_where(now, [&](std::size_t i) { return followed(before, now, i); });
    if (followers >= enough) return followers;
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    now = light_of(board);
  }
  return fail(fmt::format("expected {} cameras to gather more and show it: {}", enough,
                          words(before, now)));
}

Result<std::string> dim_and_look(Board& board, std::uint64_t steps_before) {
  if (auto on = await_poses(board, board.poses().size(), kPosesToGoOn, kPosePatience); !on) {
    return fail("with light control: " + on.error().message);
  }
  const Light before = await_rest(board);
  const Time dimmed = host_now();
  board.lighting().dim_to(kDimmed);
  const auto followers = await_followers(board, before);
  if (!followers) return tl::unexpected(followers.error());
  const double settled_s = seconds_between(dimmed, host_now());
  if (auto on = await_poses(board, board.poses().size(), kPosesToGoOn, kPosePatience); !on) {
    return fail("in the dark: " + on.error().message);
  }
  const std::uint64_t steps = light_of(board).iris_steps - steps_before;
  if (steps == 0) return fail("no iris step arrived");
  return fmt::format(
      "{:.0f} % of the light: {} of {} cameras bright again after {:.1f} s, {} iris "
      "steps",
      1e2 * kDimmed, *followers, before.mean_dn.size(), settled_s, steps);
}

Result<std::string> control_and_restore(Board& board) {
  const auto process = board.service("MainPID");
  if (!process) return process;
  const std::size_t journal = board.journal().size();
  const std::size_t first = board.poses().size();
  const std::uint64_t steps = light_of(board).iris_steps;
  if (auto done = edit_rig(board, kControl); !done) return tl::unexpected(done.error());
  const auto taken = await_journal(board, journal, {"configuration is in force"}, seconds(60));
  const auto seen = taken ? dim_and_look(board, steps) : taken;
  board.lighting().dim_to(1.0);
  if (auto done = restore_rig(board); !done) return tl::unexpected(done.error());
  if (!seen) return seen;
  const auto after = await_poses(board, board.poses().size(), kPosesToGoOn, kPosePatience);
  if (!after) return fail("in the light again: " + after.error().message);
  if (auto same = still_process(board, *process); !same) return tl::unexpected(same.error());
  return with_right_poses(board, first, *seen);
}

}  // namespace

Finding lamps_dimmed(Board& board) {
  return conclude("lamps dimmed under light control", control_and_restore(board));
}

}  // namespace dottrack::board
