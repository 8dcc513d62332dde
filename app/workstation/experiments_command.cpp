#include "app/workstation/experiments_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/telemetry/output_file.h"
#include "app/workstation/complain.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/experiments.h"
#include "app/workstation/status_line.h"

namespace dottrack::workstation {
namespace {

bool any_wrong(const Experiments& e) {
  const auto wrong_drive = [](const DriveFigures& d) { return d.wrong > 0; };
  return std::any_of(std::begin(e.drive), std::end(e.drive), wrong_drive) ||
         std::any_of(std::begin(e.ramp), std::end(e.ramp), wrong_drive) ||
         std::any_of(e.acquisitions.begin(), e.acquisitions.end(),
                     [](const AcquisitionFigures& a) { return a.wrong > 0; });
}

int run(ExperimentOptions options) {
  const StatusLine line;
  options.go_on = [&](const std::string& what) { return line.show(what); };
  const auto experiments = run_experiments(options);
  line.clear();
  if (!experiments) {
    return complain(experiments.error().message, Interrupt::wanted() ? kFailed : kWrongUse);
  }
  const std::string table = table_of(*experiments);
  fmt::print("{}", table);
  if (const auto done = telemetry::write_file(options.out / "experiments.md", table); !done) {
    return complain(done.error().message, kFailed);
  }
  return any_wrong(*experiments) ? kFailed : kDone;
}

}  // namespace

void add_experiments_command(CLI::App& app, int& exit_status) {
  CLI::App* const sub =
      app.add_subcommand("experiments", "Repeat the paper's experiments in the simulated sandbox.");
  const auto options = std::make_shared<ExperimentOptions>();
  sub->add_option("--out", options->out, "Folder for the results; made when absent")->required();
  sub->add_option("--placements", options->placements, "Random placements for each number of dots")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  sub->add_option("--threads", options->threads, "For rendering; 0: as many as the machine has")
      ->check(CLI::Range(0, 256));
  sub->callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace dottrack::workstation
