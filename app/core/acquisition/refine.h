#pragma once
// One finalist's position from all its lines of sight (paper section 3.1.4 and appendix).

#include <span>

#include "app/core/acquisition/finalists.h"

namespace dottrack::acquisition {

// estimation::locate_dot over the finalist's views. Fills position, covariance, diameter and the
// cameras that agree. False, with the finalist as it was, when fewer than two agree.
bool refine_finalist(std::span<const CameraView> views, Finalist& finalist);

}  // namespace dottrack::acquisition
