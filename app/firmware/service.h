#pragma once
// dottrackd as a service: from the rig file to a running unit, and what signals do to it.

#include <filesystem>
#include <optional>

namespace dottrack::firmware {

struct ServiceOptions {
  std::filesystem::path config = "/etc/dottrack/rig.toml";
  bool allow_degraded = false;
  std::optional<double> measure_s = {};  // so long, then a report on standard output and an end
};

// SIGTERM and SIGINT end it in a safe state. SIGHUP reads the configuration anew: it takes over
// between two ticks, or after a restart of the devices where those are concerned; one that is wrong
// is refused, and the old one stays. Returns the program's exit status.
int run_service(const ServiceOptions& options);

}  // namespace dottrack::firmware
