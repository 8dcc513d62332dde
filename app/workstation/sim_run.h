#pragma once
// The loop against the simulated world, with exact truth beside it.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/telemetry/recorder.h"
#include "app/workstation/run_summary.h"
#include "app/workstation/truth_record.h"
#include "hal/base/result.h"
#include "host_sim/scenarios/scene.h"
#include "host_sim/scenarios/scene_renderer.h"

namespace dottrack::workstation {

struct SimOptions {
  std::filesystem::path out;
  std::filesystem::path record;  // where the frames go, as `replay` reads them; empty: nowhere
  bool pictures = true;          // overlay pictures and plots
  // Folder with what the tracker is told of its cameras (host_sim::write_calibrated_rig); empty:
  // the truth.
  std::filesystem::path models;
  // Takes why ticks have no pose, for a person; empty function: nobody asks.
  std::function<void(const std::string&)> explain;
  telemetry::RecordWriter* more = nullptr;  // takes every tick's record, too
  // Called after every tick with the ticks done; false ends the run there.
  std::function<bool(std::uint64_t)> go_on;
};

struct SimSummary {
  RunSummary loop;
  Accuracy accuracy;
  FilterAccuracy filtered;
  std::vector<TruthRow> rows;  // one a tick
  std::uint64_t ticks_asked = 0;
  double ticks_per_s = 0.0;  // rendering and everything, once the still hall is rendered

  // Whether the run did what the scene is for: a lock where there is a vehicle, none where there is
  // not, and never a wrong one.
  bool good(const host_sim::Scene& scene) const;
};

// Writes what `replay` writes into options.out and truth.tum, plots/ and rig/, with which the
// recorded frames can be replayed. The same scene gives the same bytes, but for report.json and the
// plot of times. `renderer` is of this scene. An error is wrong input: nothing was run.
Result<SimSummary> simulate(const host_sim::Scene& scene, host_sim::SceneRenderer& renderer,
                            const SimOptions& options);

}  // namespace dottrack::workstation
