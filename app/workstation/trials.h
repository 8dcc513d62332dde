#pragma once
// Random placements of the vehicle, an acquisition each: how often the tracker locks on, how well
// it knows how sure it can be, and that it never locks on to the wrong thing.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
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
  std::uint64_t first = 0;  // index of the first placement
  std::uint64_t count = 0;
  int ticks = 3;  // for which each stands still until there is a lock; the noise differs
  // Pictures as a run's ticks have them, at a third of the speed.
  host_sim::Detail detail = host_sim::Detail::quick;
  // Called after every placement with those done; false ends the run there.
  std::function<bool(std::uint64_t)> go_on;
};

enum class Outcome : std::uint8_t {
  right_lock,
  wrong_lock,  // off by more than kWrongLock_mm or kWrongLock_deg, or of a vehicle not there
  held_back,   // something was found, but not believed in any tick
  no_lock,
};

// One word each: "right"; "wrong"; "held_back"; "none".
std::string_view to_string(Outcome outcome);

// The best selection of the first tick that had one, believed or not.
struct Candidate {
  double false_lock_probability = 1.0;
  bool right = false;
};

struct Trial {
  std::uint64_t index = 0;
  // Where the vehicle stands; 0 without one.
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
  int dots = 0;               // on the target
  int dots_in_two_views = 0;  // truly visible to two cameras or more
  Outcome outcome = Outcome::no_lock;
  core::Reason reason = core::Reason::none;  // of the last tick
  int lock_tick = -1;                        // from 0; -1: never
  double position_mm = 0.0;                  // error of a lock
  double attitude_deg = 0.0;
  std::optional<Candidate> candidate;
  Duration acquisition{};  // of the tracker alone, all ticks

  bool locked() const { return lock_tick >= 0; }
  // Whether there was enough to lock on to: four dots, or all three of three, in two views each.
  bool lockable() const { return dots > 0 && dots_in_two_views >= (dots < 4 ? dots : 4); }
};

struct TrialRun {
  std::vector<Trial> trials;
  double trials_per_s = 0.0;  // rendering and everything, once the still hall is rendered
};

// Writes acquisitions.csv, a line a placement, and calibration.csv into options.out. A placement
// depends on the scene and its index alone, so that runs of parts of a range add up to a run of all
// of it: their acquisitions.csv can be joined. An error is wrong input, or a file that cannot be
// written. `renderer` is of this scene or one with the same hall and cameras.
Result<TrialRun> run_trials(const host_sim::Scene& scene, host_sim::SceneRenderer& renderer,
                            const TrialOptions& options);

}  // namespace dottrack::workstation
