// dottrack: the tracker's tools on a workstation.
// Exit status: 0 done; 1 ran, but the job failed; 2 wrong use or wrong input.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#if __has_include("app/workstation/camera_command.h")
#include "app/workstation/camera_command.h"
#define HAVE_CAMERA
#endif
#if __has_include("app/workstation/replay_command.h")
#include "app/workstation/replay_command.h"
#define HAVE_REPLAY
#endif
#if __has_include("app/workstation/demo_command.h")
#include "app/workstation/demo_command.h"
#define HAVE_DEMO
#endif

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUse = 2;

// Only the first line of a message goes out: one clear line is the contract.
void print_error(const std::string& message) {
  const std::string line = message.substr(0, message.find('\n'));
  std::fprintf(stderr, "dottrack: %s\n", line.c_str());
}

std::string where_help_is(const CLI::App& app) {
  std::string command = "dottrack";
  for (const CLI::App* sub : app.get_subcommands()) command += " " + sub->get_name();
  return "; see " + command + " --help";
}

void add_commands([[maybe_unused]] CLI::App& app, [[maybe_unused]] int& exit_status) {
#ifdef HAVE_CAMERA
  dottrack::workstation::add_camera_command(app, exit_status);
#endif
#ifdef HAVE_REPLAY
  dottrack::workstation::add_replay_command(app, exit_status);
#endif
#ifdef HAVE_DEMO
  dottrack::workstation::add_demo_command(app, exit_status);
#endif
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
    print_error(error.what() + where_help_is(app));
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
