#include "app/workstation/unit_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "app/workstation/addressing_options.h"
#include "app/workstation/complain.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/monitor/command_exchange.h"
#include "app/workstation/monitor/live_bus.h"
#include "app/workstation/monitor/pose_words.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"

namespace dottrack::workstation {
namespace {

const std::map<std::string, dottrack_command>& actions() {
  static const std::map<std::string, dottrack_command> kActions{
      {"acquire", DOTTRACK_COMMAND_ACQUIRE},
      {"set-target", DOTTRACK_COMMAND_SET_TARGET},
      {"report-version", DOTTRACK_COMMAND_REPORT_VERSION}};
  return kActions;
}

struct UnitCommandOptions {
  std::string interface;
  std::string action;
  std::optional<unsigned> target;
  protocol::Addressing addressing;
};

Result<void> check(const UnitCommandOptions& options) {
  if (options.target.has_value() != (options.action == "set-target")) {
    return fail("command: expected the number of a target with set-target, and with nothing else");
  }
  return check_addressing(options.addressing);
}

int print_answer(const monitor::CommandAnswer& answer, const UnitCommandOptions& options) {
  if (!answer.reply) {
    return complain(options.interface +
                        ": no reply within 2 s; expected a unit that listens to "
                        "commands ([can] commands = true)",
                    kFailed);
  }
  const dottrack_reply& reply = *answer.reply;
  fmt::print("{}: {} ({} commands accepted, {} rejected so far)\n", options.action,
             dottrack_result_text(reply.result), reply.accepted, reply.rejected);
  if (options.action == "report-version") {
    fmt::print("unit: {}\n", monitor::unit_words(answer.unit));
  }
  return reply.result == 0 ? kDone : kFailed;
}

int run(const UnitCommandOptions& options) {
  if (const Result<void> checked = check(options); !checked) {
    return complain(checked.error().message, kWrongUse);
  }
  constexpr std::uint32_t kVersion = 14;
  constexpr std::uint32_t kConfiguration = 15;
  constexpr std::uint32_t kReply = 17;
  const rtos::MonotonicClock clock;
  const auto bus = monitor::listen_to(options.interface, options.addressing, clock,
                                      {kVersion, kConfiguration, kReply});
  if (!bus) return complain(bus.error().message, kWrongUse);
  dottrack_settings settings = dottrack_default_settings();
  settings.base_id = options.addressing.base_id;
  settings.extended = options.addressing.extended;
  monitor::CommandRequest request;
  request.command = actions().at(options.action);
  request.argument = static_cast<std::uint8_t>(options.target.value_or(0));
  // Different from those of the run before, most likely.
  const auto now_us = static_cast<std::uint64_t>(clock.now().time_since_epoch().count()) / 1000U;
  request.token = static_cast<std::uint16_t>(now_us);
  request.sequence = static_cast<std::uint8_t>(now_us >> 3U);
  const Result<monitor::CommandAnswer> answer = monitor::exchange(**bus, clock, settings, request);
  if (!answer) return complain(options.interface + ": " + answer.error().message, kFailed);
  return print_answer(*answer, options);
}

}  // namespace

void add_unit_command(CLI::App& app, int& exit_status) {
  CLI::App* const command = app.add_subcommand("command", "Send a command to the unit over CAN.");
  const auto options = std::make_shared<UnitCommandOptions>();
  command->add_option("INTERFACE", options->interface, "CAN interface of this machine: can0")
      ->required();
  command->add_option("ACTION", options->action, "acquire, set-target or report-version")
      ->required()
      ->check(CLI::IsMember({"acquire", "set-target", "report-version"}));
  command->add_option("TARGET", options->target, "set-target: which of the rig's, from 0")
      ->check(CLI::Range(0U, 255U));
  add_addressing_options(*command, options->addressing);
  command->callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace dottrack::workstation
