#include "app/workstation/addressing_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

namespace dottrack::workstation {

void add_addressing_options(CLI::App& command, protocol::Addressing& addressing) {
  command.add_option("--base-id", addressing.base_id,
                     "First of the unit's 64 identifiers (default 0x300)");
  command.add_flag("--extended", addressing.extended, "The unit's identifiers have 29 bits");
}

Result<void> check_addressing(const protocol::Addressing& addressing) {
  const std::uint32_t last =
      addressing.extended ? protocol::kLastExtendedBaseId : protocol::kLastBaseId;
  if (addressing.base_id <= last) return {};
  return fail(
      fmt::format("--base-id {:#x} leaves no room for 64 identifiers of {} bits; expected "
                  "at most {:#x}",
                  addressing.base_id, addressing.extended ? 29 : 11, last));
}

}  // namespace dottrack::workstation
