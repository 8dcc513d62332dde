#pragma once
// Whether covariances are true, in many halls: each with dots, light, clutter and noise of its own.
// The poses of one hall are wrong together, as they rest on the same dots; those of different halls
// are not.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/workstation/truth_record.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

// Of the poses of one run.
struct Consistency {
  std::uint64_t poses = 0;
  double position_rms_mm = 0.0;
  double nees_mean = 0.0;  // normalised squared error, six degrees of freedom: 6 when P is true
  double inside = 0.0;     // share of the poses within their 95 % ellipsoids
};

Consistency consistency_of(std::span<const PoseError> errors);

struct HallRun {
  std::string scenario;
  std::uint64_t hall = 0;  // its seed, and that of the dots' layout
  Consistency raw;         // each tick by itself
  Consistency filtered;
};

struct ConsistencyOptions {
  struct Part {
    std::string scenario;  // name or path
    std::uint64_t ticks;   // at most
  };

  std::filesystem::path out;
  std::uint64_t halls = 12;
  std::vector<Part> parts = {
      {"survey_grid", 216}, {"crane_lines", 100}, {"drive", 100}, {"ramp", 100}};
  unsigned threads = 0;  // for rendering; 0: as many as the machine has
  // Called with what is being done now; false ends it with an error.
  std::function<bool(const std::string&)> go_on;
};

// Runs every scenario in every hall; each leaves its results in a folder of its own in options.out.
Result<std::vector<HallRun>> run_halls(const ConsistencyOptions& options);

// Over the halls, with the mean's own standard error as they differ.
std::string consistency_table(std::span<const HallRun> runs);
// A line each.
std::string consistency_csv(std::span<const HallRun> runs);

}  // namespace dottrack::workstation
