#pragma once
// One random placement of the vehicle and what its acquisition came to.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "app/core/tick_result.h"
#include "app/workstation/truth_record.h"
#include "hal/base/time.h"

namespace dottrack::workstation {

enum class Outcome : std::uint8_t {
  right_lock,
  wrong_lock,  // off by more than kWrongLock_mm or kWrongLock_deg, or of a vehicle not there
  held_back,   // something was found, but not believed in any tick
  no_lock,
};
inline constexpr int kOutcomes = 4;

// One word each: "right"; "wrong"; "held_back"; "none".
std::string_view to_string(Outcome outcome);

// The best selection of the first tick that had one, believed or not.
struct Candidate {
  double false_lock_probability = 1.0;
  bool right = false;
};

struct Trial {
  // What it is of: the same three are the same placement.
  std::string scene;
  std::uint64_t seed = 0;
  std::uint64_t index = 0;
  // Where the vehicle stands; 0 without one.
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
  int dots = 0;               // on the target
  int dots_in_two_views = 0;  // truly visible to two cameras or more
  int dots_well_lit = 0;      // of those: no shadow's edge on them, and not dark
  int ticks_allowed = 0;
  Outcome outcome = Outcome::no_lock;
  core::Reason reason = core::Reason::none;  // of the last tick
  int lock_tick = -1;                        // from 0; -1: never
  double position_mm = 0.0;                  // error of a lock
  double attitude_deg = 0.0;
  double lock_probability = 1.0;  // of a lock: that it is false, as the tracker believed
  std::optional<Candidate> candidate;
  // Of the last search's best selection: how many dots it has, in how many views each.
  int dots_matched = 0;
  int min_views = 0;
  Duration acquisition{};  // of the tracker alone, all ticks

  bool locked() const { return lock_tick >= 0; }
  // Whether there was enough to lock on to: four dots, or all three of three, in two views each.
  bool lockable() const { return enough(dots_in_two_views); }
  // Whether that was so with shadows reckoned in.
  bool well_lit() const { return enough(dots_well_lit); }
  bool enough(int seen) const { return dots > 0 && seen >= (dots < 4 ? dots : 4); }
};

// Takes what one tick came to into its trial; `vehicle`: where it truly was, if there was one.
void take(const core::TickResult& result, const std::optional<TruePose>& vehicle, Trial& trial);

}  // namespace dottrack::workstation
