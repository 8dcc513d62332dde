#include "app/workstation/demo_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "app/workstation/accuracy.h"
#include "app/workstation/replay.h"
#include "app/workstation/tum_reader.h"
#include "host_sim/scenarios/scene_files.h"
#include "host_sim/scenarios/scenes.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUse = 2;

struct DemoOptions {
  fs::path out;
  std::uint64_t seed = 1;
  std::uint64_t ticks = 90;
};

struct Outcome {
  ReplaySummary replay;
  Accuracy accuracy;

  bool good() const {
    return replay.first_lock_tick >= 0 && accuracy.compared > 0 && accuracy.wrong_lock_ticks == 0 &&
           accuracy.without_truth == 0 && replay.output_fault.empty();
  }
};

int report(const std::string& message, int status) {
  fmt::print(stderr, "dottrack: {}\n", message);
  return status;
}

Result<void> write_recording(const host_sim::Scene& scene, const DemoOptions& options) {
  auto truth = host_sim::write_truth(scene, options.ticks, options.out / "truth.tum");
  if (!truth) return truth;
  return host_sim::write_frames(scene, options.ticks, options.out / "frames");
}

Result<Outcome> track(const DemoOptions& options) {
  ReplayOptions replay_options;
  replay_options.rig = options.out / "rig" / "rig.toml";
  replay_options.frames = options.out / "frames";
  replay_options.out = options.out / "replay";
  const auto summary = replay(replay_options);
  if (!summary) return tl::unexpected<Error>(summary.error());
  const auto poses = read_tum(replay_options.out / "poses.tum");
  if (!poses) return tl::unexpected<Error>(poses.error());
  const auto truth = read_tum(options.out / "truth.tum");
  if (!truth) return tl::unexpected<Error>(truth.error());
  return Outcome{*summary, compare(*poses, *truth)};
}

void print_row(const std::string& what, const std::string& value) {
  fmt::print("  {:<24} {}\n", what, value);
}

void print_errors(const Accuracy& a) {
  print_row("wrong-lock ticks", std::to_string(a.wrong_lock_ticks));
  print_row("position error",
            fmt::format("{:.2f} mm RMS, {:.2f} mm max", a.position_rms_mm, a.position_max_mm));
  print_row("attitude error",
            fmt::format("{:.3f} deg RMS, {:.3f} deg max", a.attitude_rms_deg, a.attitude_max_deg));
}

void print_table(const Outcome& outcome, const DemoOptions& options) {
  const ReplaySummary& r = outcome.replay;
  print_row("ticks", std::to_string(r.ticks));
  print_row("first lock",
            r.first_lock_tick < 0 ? "never" : fmt::format("tick {}", r.first_lock_tick));
  print_row("tracking ticks", std::to_string(r.tracking_ticks));
  print_errors(outcome.accuracy);
  print_row("mean RMS residual", fmt::format("{:.2f} mm", 1000.0 * r.mean_rms_residual_m));
  print_row("allocations in the loop", std::to_string(r.allocations_in_loop));
  fmt::print("pictures: {}\n", (options.out / "replay" / "pictures").string());
  fmt::print("poses: {}, truth: {}\n", (options.out / "replay" / "poses.tum").string(),
             (options.out / "truth.tum").string());
}

void announce(const host_sim::Scene& scene, const DemoOptions& options) {
  const double seconds = static_cast<double>(options.ticks) / scene.frame_rate_hz;
  fmt::print(
      "A rover with {} dots drives for {:.1f} s among things that look like dots; {} "
      "cameras, seed {}.\n",
      scene.target.size(), seconds, scene.cameras.size(), options.seed);
  std::fflush(stdout);
}

int run(const DemoOptions& options) {
  const host_sim::Scene scene = host_sim::make_demo_scene(options.seed);
  if (const auto rig = host_sim::write_rig(scene, options.out / "rig"); !rig) {
    return report(rig.error().message, kWrongUse);
  }
  announce(scene, options);
  if (const auto recording = write_recording(scene, options); !recording) {
    return report(recording.error().message, kFailed);
  }
  const auto outcome = track(options);
  if (!outcome) return report(outcome.error().message, kFailed);
  print_table(*outcome, options);
  if (!outcome->replay.output_fault.empty()) return report(outcome->replay.output_fault, kFailed);
  return outcome->good() ? kDone : kFailed;
}

}  // namespace

void add_demo_command(CLI::App& app, int& exit_status) {
  CLI::App* const command =
      app.add_subcommand("demo", "Render a small synthetic scene and track it.");
  const auto options = std::make_shared<DemoOptions>();
  command->add_option("--out", options->out, "Folder for the scene and the results")->required();
  command->add_option("--seed", options->seed, "Which scene")->capture_default_str();
  command->add_option("--ticks", options->ticks, "How many images a camera, 30 a second")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace dottrack::workstation
