#include "app/workstation/light_command.h"

#include <fmt/format.h>

#include <memory>

#include "app/telemetry/output_file.h"
#include "app/workstation/complain.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/light_figures.h"
#include "app/workstation/loop_files.h"
#include "app/workstation/status_line.h"

namespace dottrack::workstation {
namespace {

int run(LightRunOptions options) {
  if (const auto made = make_folder(options.out); !made) {
    return complain(made.error().message, kWrongUse);
  }
  const StatusLine line;
  options.go_on = [&](const std::string& what) { return line.show(what); };
  const auto comparisons = compare_light(options);
  line.clear();
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
