#pragma once
// Random placements of the vehicle, one acquisition each: how often the tracker locks on, and that
// it never locks on to the wrong thing.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/core/reason.h"
#include "hal/base/result.h"
#include "hal/base/time.h"
#include "host_sim/scenarios/scene.h"
#include "host_sim/scenarios/scene_renderer.h"

namespace dottrack::workstation {

struct TrialOptions {
  std::filesystem::path out;
  std::uint64_t count = 0;
  // Called after every placement with those done; false ends the run there.
  std::function<bool(std::uint64_t)> go_on;
};

enum class Outcome : std::uint8_t { right_lock, wrong_lock, no_lock };

// One word each: "right"; "wrong"; "none".
std::string_view to_string(Outcome outcome);

struct Trial {
  std::uint64_t index = 0;
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
  int dots = 0;               // on the target
  int dots_in_two_views = 0;  // truly visible to two cameras or more
  Outcome outcome = Outcome::no_lock;
  core::Reason reason = core::Reason::none;
  double position_mm = 0.0;  // error of a lock
  double attitude_deg = 0.0;
  Duration acquisition{};  // of the tracker alone

  // Whether there was enough to lock on to: four dots, or all three of three, in two views each.
  bool lockable() const { return dots_in_two_views >= (dots < 4 ? dots : 4); }
};

struct TrialSummary {
  std::uint64_t placements = 0;
  std::uint64_t right = 0;
  std::uint64_t wrong = 0;
  std::uint64_t none = 0;
  std::map<std::string, std::uint64_t> reasons;  // of those without a lock
};

// Of those trials that were lockable, or of the others.
TrialSummary summary_of(const std::vector<Trial>& trials, bool lockable);

struct TrialRun {
  std::vector<Trial> trials;
  double trials_per_s = 0.0;  // rendering and everything, once the still hall is rendered
};

// Writes acquisitions.csv, a line a placement, into options.out. An error is wrong input, or a file
// that cannot be written.
// The scene has a vehicle; `renderer` is of this scene or one with the same hall and cameras.
Result<TrialRun> run_trials(const host_sim::Scene& scene, host_sim::SceneRenderer& renderer,
                            const TrialOptions& options);

}  // namespace dottrack::workstation
