#pragma once
// report.json: what a run comes to, for people and for scripts. docs/outputs.md describes its keys.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "app/config/rig_file.h"
#include "app/workstation/run_tally.h"

namespace dottrack::workstation {

// What the records of a run do not know.
struct RunFacts {
  std::uint64_t allocations_in_loop = 0;
  bool allocation_trap_complete = false;
  std::uint64_t bad_frames = 0;
  std::size_t tracker_bytes = 0;
  // Further members, each a key and its value as JSON, in this order.
  std::vector<std::pair<std::string, std::string>> more;
};

std::string report_json(const config::RigConfig& rig, const RunTally& tally, const RunFacts& facts);

}  // namespace dottrack::workstation
