#include "app/workstation/reason_words.h"

#include <array>
#include <cstddef>

namespace dottrack::workstation {
namespace {

// By the reason's number.
constexpr std::array<ReasonWords, 16> kWords{{
    {"", ""},
    // no_frames
    {"No camera delivered an image.",
     "See that the cameras run and are triggered; in a replay, that the folder holds "
     "images of this tick."},
    // too_few_cameras
    {"Fewer than two cameras delivered an image that can be used; a place in space takes "
     "two.",
     "See after the cameras that are marked below."},
    // too_few_regions
    {"Fewer than two cameras see anything that could be a dot.",
     "See below where things are lost. Nothing before the gates: light, exposure, "
     "intensity_dn, min_contrast_dn, polarity. Not a dot's size: distance_m, the target's "
     "diameters. Not its shape: blur, glare, dots half hidden."},
    // too_few_finalists
    {"Fewer dots than the target has were seen at one place by two cameras.",
     "See that two cameras or more look at the target, that every camera's model is of "
     "the camera as it hangs now, and that distance_m and diameters are true."},
    // no_matching_subset
    {"Of the places in space where dots may be, no set lies as the target's dots do.",
     "The target may be out of sight or hidden in part. Else see that target.csv has the "
     "dots' true places and diameters, and that the camera models are good."},
    // upside_down
    {"The only match hangs upside down.",
     "Most likely it is a chance match and the target is out of sight. Set upright = "
     "false if the vehicle may turn over."},
    // residual
    {"The dots were found, but do not fit the target within max_rms_residual_m.",
     "See that target.csv and the camera models are true; raise max_rms_residual_m only "
     "if they cannot be better."},
    // not_confirmed
    {"A pose was found, but looking again from there the dots were not where they should "
     "be.",
     "Most likely it was a chance match. If it stays, see that the camera models and "
     "target.csv are true."},
    // too_few_dots
    {"Fewer than three dots were seen by two cameras each.",
     "Something may hide them, or the vehicle moved further than max_step_m and is no "
     "longer where it was looked for."},
    // degenerate_geometry
    {"The dots that were seen lie nearly on a line and leave the pose open.",
     "Let more cameras see more of the dots, or spread the dots out."},
    // step_too_large
    {"A dot seems to have moved further than max_step_m since the tick before.",
     "If the vehicle can be that fast, raise max_step_m or the frame rate; else "
     "something else was taken for the dot."},
    // work_budget
    {"The search has not come to its end in this tick; it goes on in the next one.",
     "Nothing, as long as it ends. Else leave it less to search: a narrower intensity_dn, "
     "a higher min_contrast_dn, a closer distance_m, less clutter."},
    // ambiguous
    {"A pose was found, but another one explains the images nearly as well.",
     "Nothing, if a lock follows. Else make the target less symmetric (`dottrack target "
     "check` says which dots to move), or let more cameras see it."},
    // stopped
    {"The unit was told to stop.", "Start it again."},
    // held_back
    {"A pose was found, but it may be one by chance: further ticks are to confirm it.",
     "Nothing, if a lock follows. Else let more cameras see more dots, give the dots' "
     "normals in target.csv, take look-alikes away, or allow more with "
     "max_false_lock_probability."},
}};

}  // namespace

ReasonWords words_for(core::Reason reason) {
  const auto number = static_cast<std::size_t>(reason);
  return number < kWords.size() ? kWords[number] : ReasonWords{};
}

}  // namespace dottrack::workstation
