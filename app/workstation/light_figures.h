#pragma once
// What light control is worth: a scenario with it against the same without.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/telemetry/recorder.h"
#include "hal/base/result.h"
#include "host_sim/scenarios/scene.h"

namespace dottrack::workstation {

struct LightFigures {
  std::uint64_t ticks = 0;
  std::uint64_t without_pose = 0;  // after the first lock
  std::uint64_t longest_gap = 0;   // ticks without a pose, one after another
  std::uint64_t bloomed_views = 0;
  std::uint64_t saturated = 0;  // pictures of cameras with saturated pixels in the dots
  double position_rms_mm = 0.0;
  // From a change of the light (its end where it is faded) until no camera has saturated dots and
  // all but one in eight have dots as bright as they should be; the longest. -1: one never did.
  double settled_after_s = 0.0;
  std::vector<std::string> faults;  // "cam5 after 6.2 s"
};

// Takes the records of a run, tick by tick.
class LightTally final : public telemetry::RecordWriter {
 public:
  // `scene` outlives this.
  explicit LightTally(const host_sim::Scene& scene);

  LightFigures figures() const;

 private:
  void do_write(const telemetry::CycleRecord& record) override;
  void count_cameras(const telemetry::CycleRecord& record);
  void note_faults(const telemetry::CycleRecord& record);

  const host_sim::Scene& scene_;
  std::vector<double> changes_s_;  // instants after which the light should settle
  std::vector<bool> settled_;      // tick by tick
  LightFigures figures_;
  bool locked_ = false;
  std::uint64_t gap_ = 0;
  CameraSet named_;
};

struct LightComparison {
  std::string scenario;
  LightFigures off;
  LightFigures on;
};

struct LightRunOptions {
  std::filesystem::path out;
  std::uint64_t ticks = 0;  // of each scenario, at most; 0: all
  unsigned threads = 0;     // for rendering; 0: as many as the machine has
  // Called with what is being done now; false ends the runs with an error.
  std::function<bool(const std::string&)> go_on;
};

// The scenarios of light, and `drive` for comparison.
Result<std::vector<LightComparison>> compare_light(const LightRunOptions& options);

// A table in Markdown.
std::string table_of(const std::vector<LightComparison>& comparisons);

}  // namespace dottrack::workstation
