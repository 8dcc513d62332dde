#pragma once
// Random placements of the vehicle, an acquisition each: how often the tracker locks on, how well
// it knows how sure it can be, and that it never locks on to the wrong thing.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "app/workstation/trial.h"
#include "hal/base/result.h"
#include "host_sim/scenarios/scene.h"
#include "host_sim/scenarios/scene_renderer.h"

namespace dottrack::workstation {

struct TrialOptions {
  std::filesystem::path out;
  std::uint64_t first = 0;  // index of the first placement
  std::uint64_t count = 0;
  int ticks = 10;  // until there must be a lock; the noise differs from tick to tick
  // Of the vehicle from the first tick on, straight ahead; 0: it stands still. What is held back
  // has to move before it is believed.
  double speed_m_s = 0.5;
  // Pictures as a run's ticks have them, at a third of the speed.
  host_sim::Detail detail = host_sim::Detail::quick;
  // Called after every placement with those done; false ends the run there.
  std::function<bool(std::uint64_t)> go_on;
};

struct TrialRun {
  std::vector<Trial> trials;
  std::uint64_t asked = 0;
  double trials_per_s = 0.0;  // rendering and everything, once the still hall is rendered
};

// Writes acquisitions.csv, a line a placement, calibration.csv and report.json into options.out. A
// placement depends on the scene and its index alone, so that runs of parts of a range add up to a
// run of all of it: their acquisitions.csv can be joined. An error is wrong input, or a file that
// cannot be written. `renderer` is of this scene or one with the same hall and cameras.
Result<TrialRun> run_trials(const host_sim::Scene& scene, host_sim::SceneRenderer& renderer,
                            const TrialOptions& options);

}  // namespace dottrack::workstation
