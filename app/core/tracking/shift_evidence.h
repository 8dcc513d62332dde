#pragma once
// How far a camera's dots are off, all alike, from where the other cameras say they are: what a
// knock against its mount does to its pictures.

#include <Eigen/Core>
#include <array>

#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "app/core/tracking/follow.h"
#include "hal/base/camera_set.h"

namespace dottrack::tracking {

// The normal equations of a camera's shift: information * shift_px = score. Each coordinate of a
// dot in its picture counts as one, less what the pose would give way. Sums of them are those of
// the ticks together.
struct ShiftEvidence {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d score = Eigen::Vector2d::Zero();
};

// Of a cycle of tracking that found `followed`: what each camera's dots say against a pose from the
// other cameras alone. A dot that is off differently from the camera's others (half in the shade,
// half behind a mast) does not count; nothing is known of a camera with fewer than two that agree.
// Nothing rests on `distrusted` cameras, as when they were followed; there is evidence of them,
// too.
std::array<ShiftEvidence, kMaxCameras> shift_evidence(const core::Rig& rig,
                                                      const Follower& follower,
                                                      const FollowResult& followed,
                                                      CameraSet distrusted);

}  // namespace dottrack::tracking
