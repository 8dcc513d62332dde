// dottrackd: the program of the ceiling unit.
// Exit status: 0 done; 1 ran, but the job failed; 2 wrong use or wrong input.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "app/firmware/device_report.h"
#include "app/firmware/exit_status.h"
#include "app/firmware/journal.h"
#include "app/firmware/service.h"

namespace {

using namespace dottrack::firmware;
using dottrack::telemetry::Severity;

struct Options {
  ServiceOptions service;
  bool check = false;
  bool list_devices = false;
};

int list_devices() {
  std::fputs(describe(find_devices()).c_str(), stdout);
  return kDone;
}

int check(const std::filesystem::path& path) {
  const auto config = dottrack::config::load_rig(path);
  if (!config) {
    log_line(Severity::error, config.error().message);
    return kWrongUse;
  }
  log_warnings(config->warnings);
  const std::vector<std::string> lines = missing(*config, find_devices());
  for (const std::string& line : lines) log_line(Severity::error, path.string() + ": " + line);
  if (!lines.empty()) return kFailed;
  fmt::print("{}: good, and every device is there\n", path.string());
  return kDone;
}

void add_options(CLI::App& app, Options& options) {
  app.set_version_flag("--version", "dottrackd " DOTTRACK_VERSION);
  app.add_option("--config", options.service.config, "the rig file")->capture_default_str();
  app.add_flag("--check", options.check, "only validate the rig file and the devices it names");
  app.add_flag("--list-devices", options.list_devices,
               "print what this machine has, as lines for the rig file");
  app.add_flag("--allow-degraded", options.service.allow_degraded,
               "run without real-time settings or watchdog that cannot be had, and say so");
  app.add_option("--measure", options.service.measure_s,
                 "run for so many seconds, then print latencies and ages")
      ->check(CLI::Range(1.0, 1e6));
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app("Tracks a vehicle by its dots and broadcasts its pose on CAN.", "dottrackd");
  add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    log_line(Severity::error, std::string(error.what()) + "; see dottrackd --help");
    return kWrongUse;
  }
  if (options.list_devices) return list_devices();
  if (options.check) return check(options.service.config);
  return run_service(options.service);
}

}  // namespace

int main(int argc, char** argv) {
  // libcamera tells of every start at length; its errors are enough.
  setenv("LIBCAMERA_LOG_LEVELS", "*:ERROR", /*overwrite=*/0);
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    log_line(Severity::error, error.what());
    return kFailed;
  }
}
