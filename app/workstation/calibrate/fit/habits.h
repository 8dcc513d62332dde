#pragma once
// What the cameras of a rig have in common: how far from square their pixels are, from the middle
// their centres, from the image plane's normal their lenses' axes; and what their lenses bend,
// where they are of one make.

#include "app/workstation/calibrate/fit/adjustment.h"
#include "app/workstation/calibrate/fit/information.h"

namespace dottrack::calibrate {

// Changes the cameras' priors to what the cameras themselves show, never looser than at first:
// where no camera is off by more than its noise, none is believed to be. The largest relative
// change.
double learn_habits(Adjustment& adjustment, const Information& information);

}  // namespace dottrack::calibrate
