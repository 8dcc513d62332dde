#pragma once
// What light control is worth: a scenario with it against the same without.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/workstation/light_tally.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

struct LightComparison {
  std::string scenario;
  LightFigures off;
  LightFigures on;
};

struct LightRunOptions {
  std::filesystem::path out;
  std::uint64_t ticks = 0;     // of each scenario, at most; 0: all
  double frame_rate_hz = 0.0;  // in place of the scenarios', for as many seconds; 0: theirs
  unsigned threads = 0;        // for rendering; 0: as many as the machine has
  // Called with what is being done now; false ends the runs with an error.
  std::function<bool(const std::string&)> go_on;
};

// The scenarios of light, and `drive` for comparison.
Result<std::vector<LightComparison>> compare_light(const LightRunOptions& options);

// A table in Markdown.
std::string table_of(const std::vector<LightComparison>& comparisons);

}  // namespace dottrack::workstation
