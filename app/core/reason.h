#pragma once
// Why a tick ended as it did. The numbers go out on CAN and into files: they never change meaning.

#include <cstdint>
#include <string_view>

namespace dottrack::core {

enum class State : std::uint8_t { acquiring = 0, tracking = 1 };

enum class Reason : std::uint8_t {
  none = 0,                  // a pose was found
  no_frames = 1,             // no camera delivered
  too_few_cameras = 2,       // fewer than two cameras delivered a usable image
  too_few_regions = 3,       // fewer than two cameras see any region of a dot's size
  too_few_finalists = 4,     // fewer than n dots seen by two cameras (paper 3.1.4)
  no_matching_subset = 5,    // no n finalists look like the target within tolerance (3.1.4)
  upside_down = 6,           // the only match hangs upside down (3.1.4)
  residual = 7,              // RMS residual over its threshold (3.1.5, 3.2.4)
  not_confirmed = 8,         // the confirming run of tracking refused the acquisition (3.1.5)
  too_few_dots = 9,          // fewer than three dots triangulated (3.2.3)
  degenerate_geometry = 10,  // the dots seen do not determine a pose
  step_too_large = 11,       // a dot moved further than max_step_m (3.2.3)
  work_budget = 12,          // acquisition's bound of work in a tick was reached: it goes on
  ambiguous = 13,            // as good a match by chance, or another labelling as good
  stopped = 14,              // the unit was told to stop: the last message it sends
  held_back = 15,            // found, but it may be chance: further ticks are to confirm it
};

// One word each: "tracking"; "too_few_regions".
std::string_view to_string(State state);
std::string_view to_string(Reason reason);

}  // namespace dottrack::core
