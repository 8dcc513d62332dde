#pragma once
// Which exposure of the cameras a pose is of, by its stamp alone.

#include <optional>
#include <span>

#include "hal/base/time.h"
#include "host_sim/usb_cameras/usb_camera_bank.h"

namespace dottrack::board {

struct ExposureMatch {
  host_sim::Barrier barrier;
  Duration late{};  // the stamp against the middle of that exposure
};

// `stamp`: on this machine's clock. `exposure`: how long the cameras exposed. The nearest barrier,
// unless it is `reach` or further away.
std::optional<ExposureMatch> match_exposure(Time stamp, std::span<const host_sim::Barrier> barriers,
                                            Duration exposure, Duration reach);

}  // namespace dottrack::board
