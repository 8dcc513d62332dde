#include "app/workstation/dbc_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "app/workstation/addressing_options.h"
#include "app/workstation/dbc/dottrack_dbc.h"
#include "app/workstation/dbc/rebased_dbc.h"
#include "app/workstation/exit_status.h"

namespace dottrack::workstation {
namespace {

int run(const protocol::Addressing& addressing) {
  if (const Result<void> checked = check_addressing(addressing); !checked) {
    fmt::print(stderr, "dottrack: {}\n", checked.error().message);
    return kWrongUse;
  }
  const std::string text = dbc::rebased(dbc::dottrack_dbc(), addressing);
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (written) return kDone;
  fmt::print(stderr, "dottrack: standard output cannot be written\n");
  return kFailed;
}

}  // namespace

void add_dbc_command(CLI::App& app, int& exit_status) {
  CLI::App* const command = app.add_subcommand(
      "dbc", "Print the layout of the CAN messages (DBC) for a base identifier.");
  const auto addressing = std::make_shared<protocol::Addressing>();
  add_addressing_options(*command, *addressing);
  command->callback([addressing, &exit_status] { exit_status = run(*addressing); });
}

}  // namespace dottrack::workstation
