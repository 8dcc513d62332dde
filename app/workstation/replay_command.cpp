#include "app/workstation/replay_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "app/workstation/exit_status.h"
#include "app/workstation/replay.h"

namespace dottrack::workstation {
namespace {

void print_error(const std::string& line) {
  fmt::print(stderr, "dottrack: {}\n", line);
}

std::string lock_line(const RunSummary& summary) {
  if (summary.first_lock_tick < 0) return fmt::format("no lock in {} ticks", summary.ticks);
  return fmt::format("locked at tick {}, tracking {} of {} ticks, {} reacquisitions",
                     summary.first_lock_tick, summary.tracking_ticks, summary.ticks,
                     summary.reacquisitions);
}

void print_last_lock(const core::TickResult& lock) {
  const Eigen::Vector3d& p = lock.pose.position_m;
  const Eigen::Quaterniond& q = lock.pose.orientation;
  fmt::print("pose at tick {}: x {:.6f} y {:.6f} z {:.6f} m, q(xyzw) {:.6f} {:.6f} {:.6f} {:.6f}\n",
             lock.tick, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
}

void print_summary(const ReplayOptions& options, const RunSummary& summary) {
  fmt::print("{}\n", lock_line(summary));
  if (summary.last_lock) {
    fmt::print("mean residual {:.3f} mm\n", 1000.0 * summary.mean_rms_residual_m);
    print_last_lock(*summary.last_lock);
  }
  if (summary.bad_frames > 0) fmt::print("unreadable images: {}\n", summary.bad_frames);
  fmt::print("allocations in the loop: {}; memory of the tracker: {:.1f} MB\n",
             summary.allocations_in_loop, static_cast<double>(summary.tracker_bytes) / 1e6);
  fmt::print("results: {}; pictures: {}\n", options.out.string(),
             (options.out / "pictures").string());
}

void print_text(const std::string& text) {
  fmt::print("{}", text);
}

int run(const ReplayOptions& options) {
  const Result<RunSummary> summary = replay(options);
  if (!summary) {
    print_error(summary.error().message);
    return kWrongUse;
  }
  if (!summary->output_fault.empty()) {
    print_error(summary->output_fault);
    return kFailed;
  }
  print_summary(options, *summary);
  return summary->first_lock_tick < 0 ? kFailed : kDone;
}

}  // namespace

void add_replay_command(CLI::App& app, int& exit_status) {
  CLI::App* const command = app.add_subcommand("replay", "Run the loop on recorded images.");
  const auto options = std::make_shared<ReplayOptions>();
  command->add_option("rig", options->rig, "The rig: cameras and target (rig.toml)")->required();
  command
      ->add_option("--frames", options->frames,
                   "Folder with <camera>/<tick, six digits>.pgm, 8-bit grey")
      ->required();
  command->add_option("--out", options->out, "Folder for the results; made when absent")
      ->required();
  command->add_option("--repeat", options->repeat, "Show the last set of images this many times")
      ->check(CLI::Range(1, 1000000));
  command->add_flag_callback(
      "--explain", [options] { options->explain = print_text; },
      "Say of every tick without a pose why it has none");
  command->callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace dottrack::workstation
