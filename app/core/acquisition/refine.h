#pragma once
// One finalist's position from all its lines of sight (paper section 3.1.4 and appendix).

#include <span>

#include "app/core/acquisition/finalists.h"
#include "app/core/acquisition/view_finder.h"

namespace dottrack::acquisition {

// Lines of sight to one dot miss its position by less than this, pixels; what misses by more is
// another dot's, or half hidden.
inline constexpr double kSureResidual_px = 1.0;

inline bool is_sure(const Finalist& finalist) {
  return finalist.worst_residual_px <= kSureResidual_px;
}

// estimation::locate_dot over the views. Fills position, covariance, diameter, worst residual and
// the cameras that agree. False, with the finalist as it was, when fewer than two agree.
bool refine_finalist(std::span<const CameraView> views, const PointViews& seen, Finalist& finalist);

// The finalist around a crossing of two lines of sight: its views are looked for at the crossing,
// and again where they put the dot, until nothing changes. Where the views disagree by more than
// kSureResidual_px, but at least min_views of them agree with the crossing to within it, only
// these are taken. `seen`: what is seen at the crossing. False when fewer than two views agree.
bool find_finalist(std::span<const CameraView> views, const ViewFinder& finder,
                   const PointViews& seen, const Eigen::Vector3d& crossing_m, int min_views,
                   Finalist& finalist);

}  // namespace dottrack::acquisition
