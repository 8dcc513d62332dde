#include "app/workstation/light_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>

#include "app/telemetry/output_file.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/interrupt.h"
#include "app/workstation/light_figures.h"
#include "app/workstation/loop_files.h"

namespace dottrack::workstation {
namespace {

int complain(const std::string& message, int status) {
  fmt::print(stderr, "dottrack: {}\n", message);
  return status;
}

int run(LightRunOptions options) {
  if (const auto made = make_folder(options.out); !made) {
    return complain(made.error().message, kWrongUse);
  }
  const Interrupt interrupt;
  const bool on_terminal = isatty(STDERR_FILENO) != 0;
  options.go_on = [&](const std::string& what) {
    if (on_terminal) fmt::print(stderr, "\r\x1b[K{}", what);
    return !Interrupt::wanted();
  };
  const auto comparisons = compare_light(options);
  if (on_terminal) fmt::print(stderr, "\r\x1b[K");
  if (!comparisons) {
    return complain(comparisons.error().message, Interrupt::wanted() ? kFailed : kWrongUse);
  }
  const std::string table = table_of(*comparisons);
  fmt::print("{}", table);
  if (const auto done = telemetry::write_file(options.out / "light.md", table); !done) {
    return complain(done.error().message, kFailed);
  }
  return kDone;
}

}  // namespace

void add_light_command(CLI::App& app, int& exit_status) {
  CLI::App* const sub =
      app.add_subcommand("light", "Run the scenarios of light with light control and without.");
  const auto options = std::make_shared<LightRunOptions>();
  sub->add_option("--out", options->out, "Folder for the results; made when absent")->required();
  sub->add_option("--ticks", options->ticks, "Of each scenario, at most");
  sub->add_option("--rate", options->frame_rate_hz, "Frames a second, in place of the scenarios'")
      ->check(CLI::Range(1.0, 60.0));
  sub->add_option("--threads", options->threads, "For rendering; 0: as many as the machine has")
      ->check(CLI::Range(0, 256));
  sub->callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace dottrack::workstation
