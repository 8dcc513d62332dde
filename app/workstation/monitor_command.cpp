#include "app/workstation/monitor_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/workstation/addressing_options.h"
#include "app/workstation/complain.h"
#include "app/workstation/dbc/dottrack_dbc.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/interrupt.h"
#include "app/workstation/monitor/json_lines.h"
#include "app/workstation/monitor/live_bus.h"
#include "app/workstation/monitor/live_source.h"
#include "app/workstation/monitor/live_table.h"
#include "app/workstation/monitor/log_source.h"
#include "app/workstation/monitor/mavlink_handover.h"
#include "app/workstation/monitor/monitor.h"
#include "app/workstation/monitor/notice_lines.h"
#include "app/workstation/monitor/signal_lines.h"
#include "app/workstation/monitor/text_lines.h"
#include "app/workstation/monitor/trajectory_files.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"

namespace dottrack::workstation {
namespace {

struct MonitorOptions {
  std::string interface;      // live, or the one of a log
  std::string log;            // "-": standard input; empty: live
  std::string log_interface;  // empty: that of the first frame
  protocol::Addressing addressing;
  double age_limit_s = 0.3;
  bool json = false;
  bool signals = false;
  bool strict = false;
  std::string tum;
  std::string csv;
  std::string mavlink;
  std::optional<double> seconds;
  std::optional<std::uint64_t> poses;
};

using Writers = std::vector<std::unique_ptr<monitor::Writer>>;

bool shows_table(const MonitorOptions& options) {
  const bool as_it_comes = options.log.empty() || options.log == "-";
  return as_it_comes && !options.json && !options.signals && ::isatty(STDOUT_FILENO) == 1;
}

void add_signal_lines(const MonitorOptions& options, Writers& writers) {
  using Format = monitor::SignalLines::Format;
  Result<dbc::DbcFile> layout = dbc::parse_dbc(dbc::dottrack_dbc(), "dottrack.dbc");
  if (!options.signals || !layout) return;
  writers.push_back(std::make_unique<monitor::SignalLines>(
      stdout, std::move(*layout), options.addressing, options.json ? Format::json : Format::text));
}

void add_shown(const MonitorOptions& options, Writers& writers) {
  add_signal_lines(options, writers);
  if (shows_table(options)) {
    const std::string source = options.log.empty() ? options.interface : "standard input";
    writers.push_back(std::make_unique<monitor::LiveTable>(stdout, "dottrack monitor " + source));
    return;
  }
  writers.push_back(std::make_unique<monitor::NoticeLines>());
  if (options.json) {
    writers.push_back(std::make_unique<monitor::JsonLines>(stdout));
  } else {
    writers.push_back(std::make_unique<monitor::TextLines>(stdout));
  }
}

template <class FileWriter>
Result<void> add_file(const std::string& path, Writers& writers) {
  if (path.empty()) return {};
  Result<telemetry::OutputFile> file = telemetry::OutputFile::create(path);
  if (!file) return tl::unexpected(file.error());
  writers.push_back(std::make_unique<FileWriter>(std::move(*file)));
  return {};
}

Result<void> add_mavlink(const MonitorOptions& options, Writers& writers) {
  if (options.mavlink.empty()) return {};
  auto sender = MavlinkSender::open(options.mavlink);
  if (!sender) return tl::unexpected(sender.error());
  writers.push_back(std::make_unique<monitor::MavlinkHandover>(std::move(*sender)));
  return {};
}

Result<Writers> make_writers(const MonitorOptions& options) {
  Writers writers;
  const Result<void> made =
      add_file<monitor::TumFile>(options.tum, writers)
          .and_then([&] { return add_file<monitor::CsvFile>(options.csv, writers); })
          .and_then([&] { return add_mavlink(options, writers); });
  if (!made) return tl::unexpected(made.error());
  add_shown(options, writers);
  return writers;
}

monitor::MonitorLimits limits_of(const MonitorOptions& options) {
  monitor::MonitorLimits limits;
  limits.poses = options.poses;
  if (options.seconds) {
    limits.duration = std::chrono::round<Duration>(std::chrono::duration<double>(*options.seconds));
  }
  return limits;
}

dottrack_settings settings_of(const MonitorOptions& options) {
  dottrack_settings settings = dottrack_default_settings();
  settings.base_id = options.addressing.base_id;
  settings.extended = options.addressing.extended;
  settings.age_limit_us = static_cast<std::uint32_t>(1e6 * options.age_limit_s);
  return settings;
}

int conclude(monitor::Monitor& monitor, std::uint64_t unreadable_lines, bool strict) {
  const Result<void> finished = monitor.finish(unreadable_lines);
  if (!finished) return complain(finished.error().message, kFailed);
  return monitor_exit_status(monitor.statistics(), monitor.counts(), strict);
}

int run_log(const MonitorOptions& options, std::istream& log) {
  Result<Writers> writers = make_writers(options);
  if (!writers) return complain(writers.error().message);
  monitor::LogSource source(log, options.log_interface);
  monitor::Monitor monitor(settings_of(options), std::move(*writers));
  const Interrupt interrupt;
  monitor.run(source, limits_of(options), [] { return !Interrupt::wanted(); });
  if (source.frames() == 0 && source.unreadable_lines() > 0) {
    return complain(options.log + ": no line is a CAN frame; expected the format of candump -L");
  }
  return conclude(monitor, source.unreadable_lines(), options.strict);
}

int run_file(const MonitorOptions& options) {
  if (options.log == "-") {
    std::ios::sync_with_stdio(false);
    return run_log(options, std::cin);
  }
  std::error_code ignored;
  std::ifstream file(options.log);
  if (!file || std::filesystem::is_directory(options.log, ignored)) {
    return complain(options.log + ": cannot be read; expected a log of candump");
  }
  return run_log(options, file);
}

int run_live(const MonitorOptions& options) {
  const rtos::MonotonicClock clock;
  const auto bus = monitor::listen_to(options.interface, options.addressing, clock);
  if (!bus) return complain(bus.error().message);
  Result<Writers> writers = make_writers(options);
  if (!writers) return complain(writers.error().message);
  const Duration start = std::chrono::system_clock::now().time_since_epoch();
  monitor::LiveSource source(**bus, clock, options.interface, start);
  monitor::Monitor monitor(settings_of(options), std::move(*writers));
  const Interrupt interrupt;
  monitor.run(source, limits_of(options), [] { return !Interrupt::wanted(); });
  return conclude(monitor, 0, options.strict);
}

int run(const MonitorOptions& options) {
  if (options.interface.empty() == options.log.empty()) {
    return complain("monitor: expected either an interface such as can0 or --log FILE");
  }
  if (const Result<void> checked = check_addressing(options.addressing); !checked) {
    return complain(checked.error().message);
  }
  return options.log.empty() ? run_live(options) : run_file(options);
}

void add_outputs(CLI::App& command, MonitorOptions& options) {
  command.add_flag("--json", options.json, "One JSON object a group, and one for the statistics");
  command.add_flag("--signals", options.signals, "Also every frame with every signal by name");
  command.add_option("--tum", options.tum, "File for the fresh poses: t x y z qx qy qz qw");
  command.add_option("--csv", options.csv, "File for the fresh poses, columns as in EuRoC");
  command.add_option("--mavlink", options.mavlink,
                     "HOST:PORT to which the fresh poses go as MAVLink 2 (UDP)");
}

void add_limits(CLI::App& command, MonitorOptions& options) {
  command
      .add_option("--age-limit", options.age_limit_s,
                  "Seconds after which a pose is stale (default 0.3)")
      ->check(CLI::Range(0.001, 3600.0));
  command.add_option("--for", options.seconds, "End after so many seconds")
      ->check(CLI::Range(0.001, 1e9));
  command.add_option("--poses", options.poses, "End after so many fresh poses")
      ->check(CLI::PositiveNumber);
  command.add_flag("--strict", options.strict,
                   "Exit status 1 also if anything was lost, damaged, repeated or late");
}

}  // namespace

int monitor_exit_status(const monitor::Statistics& statistics, const dottrack_counts& counts,
                        bool strict) {
  if (statistics.fresh_poses() == 0) return kFailed;
  return strict && !monitor::is_spotless(counts) ? kFailed : kDone;
}

void add_monitor_command(CLI::App& app, int& exit_status) {
  CLI::App* const command =
      app.add_subcommand("monitor", "Show the poses on a CAN bus or in a log of candump.");
  const auto options = std::make_shared<MonitorOptions>();
  command->add_option("INTERFACE", options->interface, "CAN interface of this machine: can0");
  command->add_option("--log", options->log, "Log of candump instead; - is standard input");
  command->add_option("--interface", options->log_interface,
                      "Which interface of the log (default: that of its first frame)");
  add_addressing_options(*command, options->addressing);
  add_outputs(*command, *options);
  add_limits(*command, *options);
  command->callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace dottrack::workstation
