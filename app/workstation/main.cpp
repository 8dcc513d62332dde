// dottrack: the tracker's tools on a workstation.
// Exit status: 0 done; 1 ran, but the job failed; 2 wrong use or wrong input.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "app/workstation/acquisitions_command.h"
#include "app/workstation/busload_command.h"
#include "app/workstation/calibrate_command.h"
#include "app/workstation/camera_command.h"
#include "app/workstation/consistency_command.h"
#include "app/workstation/dbc_command.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/experiments_command.h"
#include "app/workstation/light_command.h"
#include "app/workstation/monitor_command.h"
#include "app/workstation/replay_command.h"
#include "app/workstation/sim_command.h"
#include "app/workstation/survey_command.h"
#include "app/workstation/target_command.h"
#include "app/workstation/unit_command.h"

namespace {

using dottrack::workstation::kFailed;
using dottrack::workstation::kWrongUse;

// Only the first line of a message goes out: one clear line is the contract.
void print_error(const std::string& message) {
  const std::string line = message.substr(0, message.find('\n'));
  std::fprintf(stderr, "dottrack: %s\n", line.c_str());
}

// The command line up to the command that was meant: "dottrack camera project".
std::string command_of(const CLI::App& app) {
  std::string command = app.get_name();
  for (const CLI::App* sub : app.get_subcommands()) command += " " + command_of(*sub);
  return command;
}

std::string commands_of(const CLI::App& app) {
  std::string names;
  for (const CLI::App* sub : app.get_subcommands(nullptr)) {
    names += (names.empty() ? "" : ", ") + sub->get_name();
  }
  return names;
}

std::string explain(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first.empty()) return "no command; expected one of " + commands_of(app);
  if (app.get_subcommands().empty()) {
    return "unknown command \"" + first + "\"; expected one of " + commands_of(app);
  }
  return error.what() + ("; see " + command_of(app) + " --help");
}

void add_commands(CLI::App& app, int& exit_status) {
  dottrack::workstation::add_replay_command(app, exit_status);
  dottrack::workstation::add_sim_command(app, exit_status);
  dottrack::workstation::add_acquisitions_command(app, exit_status);
  dottrack::workstation::add_experiments_command(app, exit_status);
  dottrack::workstation::add_consistency_command(app, exit_status);
  dottrack::workstation::add_light_command(app, exit_status);
  dottrack::workstation::add_calibrate_command(app, exit_status);
  dottrack::workstation::add_camera_command(app, exit_status);
  dottrack::workstation::add_survey_command(app, exit_status);
  dottrack::workstation::add_target_command(app, exit_status);
  dottrack::workstation::add_monitor_command(app, exit_status);
  dottrack::workstation::add_dbc_command(app, exit_status);
  dottrack::workstation::add_unit_command(app, exit_status);
  dottrack::workstation::add_busload_command(app, exit_status);
}

int run(int argc, char** argv) {
  int exit_status = 0;
  CLI::App app("Finds and follows dot targets with calibrated cameras.", "dottrack");
  app.set_version_flag("--version", "dottrack " DOTTRACK_VERSION);
  app.require_subcommand(1);
  add_commands(app, exit_status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    print_error(explain(app, error, argc, argv));
    return kWrongUse;
  }
  return exit_status;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    print_error(error.what());
    return kFailed;
  }
}
