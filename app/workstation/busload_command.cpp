#include "app/workstation/busload_command.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string_view>

#include "app/config/rig_file.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/rig_warnings.h"

namespace dottrack::workstation {
namespace {

using config::CanUse;
using protocol::PartLoad;

// In the order of protocol::part_loads().
std::array<std::string, protocol::kParts> names_of(const CanUse& use) {
  return {use.can.addressing.fd ? "FdPose" : "Status to Orientation",
          "SigmaPosition to Correlation3",
          "Velocity, Rates",
          "Cameras",
          fmt::format("Dot1Position to Dot{}Detail", use.dots),
          "Version, Configuration",
          "Light"};
}

std::string part_line(const std::string& name, const PartLoad& part, double group_s) {
  return fmt::format("{:<32} {:>6} {:>6} {:>8.3f} {:>6.2f}\n", name, part.frames, part.every,
                     part.time_s * 1e3, part.time_s / part.every / group_s * 100.0);
}

struct Bus {
  std::string_view name;
  protocol::BitRates bit_rates;
  bool fd = false;
};

constexpr std::array<Bus, 5> kBuses{{{"125 kbit/s", {.arbitration = 125'000}},
                                     {"250 kbit/s", {.arbitration = 250'000}},
                                     {"500 kbit/s", {.arbitration = 500'000}},
                                     {"1000 kbit/s", {.arbitration = 1'000'000}},
                                     {"FD 500 kbit/s, 2 Mbit/s", {}, true}}};
constexpr std::array<double, 2> kFrameRates_hz{10.0, 30.0};
constexpr std::array<unsigned, 2> kDots{4, 8};

CanUse use_of(const Bus& bus, bool extended, double frame_rate_hz, unsigned dots) {
  CanUse use{.can = {}, .dots = dots, .frame_rate_hz = frame_rate_hz};
  use.can.addressing.extended = extended;
  use.can.addressing.fd = bus.fd;
  use.can.bit_rates = bus.bit_rates;
  return use;
}

std::string cell(const CanUse& use) {
  const protocol::BusLoad load = config::bus_load(use);
  return fmt::format(" {:.1f} %, {:.1f} ms{} |", config::tenths(load.average * 100.0),
                     config::tenths(to_seconds(load.fullest_group) * 1e3),
                     config::overload(use) ? ", refused" : "");
}

std::string table_row(const Bus& bus, bool extended) {
  std::string row = fmt::format("| {} | {} |", bus.name, extended ? "29 bits" : "11 bits");
  for (const double frame_rate_hz : kFrameRates_hz) {
    for (const unsigned dots : kDots) row += cell(use_of(bus, extended, frame_rate_hz, dots));
  }
  return row + "\n";
}

int run(const std::string& rig, bool table) {
  if (table == !rig.empty()) {
    fmt::print(stderr, "dottrack: expected either RIG or --table; see dottrack busload --help\n");
    return kWrongUse;
  }
  if (table) {
    fmt::print("{}", load_table());
    return kDone;
  }
  const auto config = config::load_rig(rig);
  if (!config) {
    fmt::print(stderr, "dottrack: {}\n", config.error().message);
    return kWrongUse;
  }
  print_warnings(*config);
  fmt::print("{}", load_text(config::can_use(*config)));
  return kDone;
}

}  // namespace

std::string load_text(const CanUse& use) {
  const protocol::Rates& rates = use.can.rates;
  const double group_s = rates.pose_every / use.frame_rate_hz;
  const auto parts = protocol::part_loads(use.can.addressing, rates, use.can.bit_rates, use.dots);
  const auto names = names_of(use);
  std::string text = fmt::format("A group each {:.1f} ms.\n{:<32} {:>6} {:>6} {:>8} {:>6}\n",
                                 group_s * 1e3, "messages", "frames", "groups", "ms", "%");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].every != 0) text += part_line(names[i], parts[i], group_s);
  }
  return text + config::describe(use) + "\n";
}

std::string load_table() {
  std::string text = "| bus | identifiers |";
  std::string line = "|---|---|";
  for (const double frame_rate_hz : kFrameRates_hz) {
    for (const unsigned dots : kDots) {
      text += fmt::format(" {} Hz, {} dots |", frame_rate_hz, dots);
      line += "---|";
    }
  }
  text += "\n" + line + "\n";
  for (const Bus& bus : kBuses) text += table_row(bus, false) + table_row(bus, true);
  return text;
}

void add_busload_command(CLI::App& app, int& exit_status) {
  CLI::App* command =
      app.add_subcommand("busload", "How much of the CAN bus a rig's messages take at worst");
  const auto rig = std::make_shared<std::string>();
  const auto table = std::make_shared<bool>(false);
  command->add_option("RIG", *rig, "rig file");
  command->add_flag("--table", *table, "of the usual bit rates instead, as a Markdown table");
  command->callback([rig, table, &exit_status] { exit_status = run(*rig, *table); });
}

}  // namespace dottrack::workstation
