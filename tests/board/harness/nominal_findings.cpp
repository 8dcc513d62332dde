#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <string_view>
#include <utility>

#include "tests/board/harness/findings.h"
#include "tests/board/harness/host_clock.h"
#include "tests/board/harness/wiring.h"

namespace dottrack::board {
namespace {

using std::chrono::seconds;

constexpr auto kFirstPosePatience = seconds(300);
constexpr double kSlowest_poses_per_s = 1.0;
constexpr int kIrisTolerance_steps = 1;
constexpr std::ptrdiff_t kPulseTolerance = 2;  // at the ends of the stretch that is looked at

Finding first_pose(Board& board, std::size_t first) {
  const ReceivedPose pose = board.poses().from(first).front();
  return {
      "boot to first pose on CAN", true,
      fmt::format("{:.1f} s after power-on", seconds_between(board.powered_on(), pose.received))};
}

// The first lock is of lenses as they were left; homing the irises then darkens the pictures.
Finding acquisition(Board& board, std::size_t first) {
  const auto messages = board.poses().from(0);
  const double took_s = seconds_between(messages.front().received, messages[first].received);
  return {"acquisition", true,
          fmt::format("in tick {} of the unit, {:.1f} s after the first; {} cameras, {} dots; {} "
                      "locks with the irises' homing",
                      first + 1, took_s, std::popcount(messages[first].message.cameras_used),
                      messages[first].message.dots_used, messages.back().message.reset_count)};
}

// `no_frames 12, too_few_dots 1`: why ticks ended without a pose.
std::string reasons_without(const std::vector<ReceivedPose>& messages) {
  std::map<std::string_view, int> counts;
  for (const ReceivedPose& pose : messages) {
    if (!is_pose(pose)) ++counts[dottrack_reason_text(pose.message.reason)];
  }
  std::string text;
  for (const auto& [reason, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", reason, count);
  }
  return text.empty() ? "none" : text;
}

Finding poses_received(Board& board, std::size_t first) {
  const auto messages = board.poses().from(first);
  const auto poses = std::count_if(messages.begin(), messages.end(), is_pose);
  const double took_s = seconds_between(messages.front().received, messages.back().received);
  const dottrack_counts counts = board.poses().counts();
  return {"poses received", counts.incomplete == 0,
          fmt::format("{} in {} ticks of {:.2f} s; {} messages incomplete; without: {}", poses,
                      messages.size(), took_s / static_cast<double>(messages.size() - 1),
                      counts.incomplete, reasons_without(messages))};
}

Finding exposures(Board& board) {
  auto& cameras = board.cameras();
  std::uint64_t skipped = 0;
  for (std::size_t i = 0; i < board.scene().cameras.size(); ++i)
    skipped += cameras.frames_skipped(i);
  const std::size_t count = cameras.barriers().size();
  return {"exposures of all cameras together", count > 0,
          fmt::format("{}, and {} left out as pictures were late; {} frames skipped as the one "
                      "before was on its way",
                      count, cameras.late_barriers(), skipped)};
}

Finding position_error(const PoseCheck& check) {
  return {"position error", check.holds(),
          fmt::format("{:.1f} mm rms, {:.1f} mm at most; {} of {} poses wrong, {} of no exposure",
                      check.truth.position_rms_m() * 1e3, check.truth.position_max_m() * 1e3,
                      check.truth.wrong(), check.truth.poses(), check.unmatched)};
}

Finding attitude_error(const PoseCheck& check) {
  return {"attitude error", check.holds(),
          fmt::format("{:.2f} deg rms, {:.2f} deg at most", check.truth.attitude_rms_deg(),
                      check.truth.attitude_max_deg())};
}

Finding stamps(Board& board, const PoseCheck& check) {
  if (check.late_ms.empty()) return {"stamps against exposures", false, "no pose to look at"};
  return {"stamps against exposures", check.unmatched == 0,
          fmt::format("{:+.0f} ms in the middle, {:+.0f} to {:+.0f} ms; clocks known to {:.1f} ms",
                      check.late_ms[check.late_ms.size() / 2], check.late_ms.front(),
                      check.late_ms.back(), to_seconds(board.time_map().uncertainty()) * 1e3)};
}

Finding iris_steps(Board& board) {
  std::uint64_t steps = 0;
  std::uint64_t idle = 0;
  std::size_t in_place = 0;
  const std::size_t cameras = board.scene().cameras.size();
  for (std::size_t i = 0; i < cameras; ++i) {
    const IrisMechanics iris = board.gpio().iris(i);
    steps += iris.steps();
    idle += iris.idle_steps();
    const int off = std::abs(iris.blades_steps() - kIrisOpening_steps);
    if (iris.was_closed() && iris.overridden() && off <= kIrisTolerance_steps) ++in_place;
  }
  return {"iris steps seen on the GPIO lines",
          in_place == cameras && idle == 0 && board.gpio().complete(),
          fmt::format("{}; {} of {} irises homed and open to {:.0f} %", steps, in_place, cameras,
                      kIrisOpening * 100.0)};
}

// Between the arrivals of two messages far apart.
Finding trigger_pulses(Board& board, std::size_t first) {
  const auto messages = board.poses().from(first);
  const auto ticks = static_cast<std::ptrdiff_t>(messages.size()) - 1;
  const auto pulses = board.gpio().trigger_pulses();
  const auto within = std::count_if(pulses.begin(), pulses.end(), [&](Time pulse) {
    const Time at = board.to_host(messages.front().boot, pulse);
    return at > messages.front().received && at <= messages.back().received;
  });
  return {"trigger pulses against ticks",
          std::abs(within - ticks) <= kPulseTolerance && board.gpio().complete(),
          fmt::format("{} pulses in {} ticks", within, ticks)};
}

}  // namespace

std::vector<Finding> nominal_findings(Board& board, std::size_t poses) {
  const auto first = await_poses(board, 0, 1, kFirstPosePatience);
  if (!first) return {{"boot to first pose on CAN", false, first.error().message}};
  const std::size_t begin = *first - 1;
  std::vector<Finding> findings{first_pose(board, begin)};
  const auto enough = await_poses(
      board, begin, poses,
      std::chrono::duration_cast<Duration>(
          std::chrono::duration<double>(static_cast<double>(poses) / kSlowest_poses_per_s)));
  if (auto asked = board.ask_time(); !asked) {
    findings.push_back({"the guest's time", false, asked.error().message});
    return findings;
  }
  findings.push_back(acquisition(board, begin));
  findings.push_back(exposures(board));
  findings.push_back(poses_received(board, begin));
  if (!enough) findings.push_back({"enough poses", false, enough.error().message});
  for (Finding& finding : bus_findings(board, begin)) findings.push_back(std::move(finding));
  const PoseCheck check = check_poses(board, begin);
  findings.push_back(position_error(check));
  findings.push_back(attitude_error(check));
  findings.push_back(stamps(board, check));
  findings.push_back(iris_steps(board));
  findings.push_back(trigger_pulses(board, begin));
  return findings;
}

}  // namespace dottrack::board
