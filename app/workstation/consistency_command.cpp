#include "app/workstation/consistency_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/telemetry/output_file.h"
#include "app/workstation/complain.h"
#include "app/workstation/consistency.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/status_line.h"

namespace dottrack::workstation {
namespace {

constexpr std::uint64_t kMostTicks = 1'000'000;

bool any_without_poses(const std::vector<HallRun>& runs) {
  return std::any_of(runs.begin(), runs.end(),
                     [](const HallRun& run) { return run.raw.poses == 0; });
}

int run(ConsistencyOptions options, std::uint64_t most_ticks) {
  for (ConsistencyOptions::Part& part : options.parts) {
    part.ticks = std::min(part.ticks, most_ticks);
  }
  const StatusLine line;
  options.go_on = [&](const std::string& what) { return line.show(what); };
  const auto runs = run_halls(options);
  line.clear();
  if (!runs) return complain(runs.error().message, Interrupt::wanted() ? kFailed : kWrongUse);
  const std::string table = consistency_table(*runs);
  fmt::print("{}", table);
  auto done = telemetry::write_file(options.out / "consistency.md", table);
  if (done) done = telemetry::write_file(options.out / "consistency.csv", consistency_csv(*runs));
  if (!done) return complain(done.error().message, kFailed);
  return any_without_poses(*runs) ? kFailed : kDone;
}

}  // namespace

void add_consistency_command(CLI::App& app, int& exit_status) {
  CLI::App* const sub = app.add_subcommand(
      "consistency", "Hold covariances against the truth in many simulated halls.");
  const auto options = std::make_shared<ConsistencyOptions>();
  const auto most_ticks = std::make_shared<std::uint64_t>(kMostTicks);
  sub->add_option("--out", options->out, "Folder for the results; made when absent")->required();
  sub->add_option("--halls", options->halls, "Halls for each scenario; seeds 1, 2, ...")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  sub->add_option("--ticks", *most_ticks, "At most so many of each run")
      ->check(CLI::Range(std::uint64_t{1}, kMostTicks));
  sub->add_option("--threads", options->threads, "For rendering; 0: as many as the machine has")
      ->check(CLI::Range(0, 256));
  sub->callback([options, most_ticks, &exit_status] { exit_status = run(*options, *most_ticks); });
}

}  // namespace dottrack::workstation
