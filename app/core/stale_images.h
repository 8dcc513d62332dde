#pragma once
// Cameras whose picture no longer changes: frozen in the camera, its driver or the grabber. Their
// dots agree with each other perfectly and are somewhere else by now.

#include <array>
#include <cstdint>

#include "app/core/camera_frame.h"
#include "hal/base/camera_set.h"

namespace dottrack::core {

// Remembers a fingerprint of each camera's last image. Sensor noise alone makes two pictures of the
// same scene differ, so an image that is the same as the one before, byte by byte, is a stale one -
// unless no camera's image has changed, which is how a still recording is shown for a while.
class StaleImages {
 public:
  // Of the delivered frames of this tick, those that are stale. One call a tick.
  CameraSet update(const std::array<CameraFrame, kMaxCameras>& frames);

 private:
  std::array<std::uint64_t, kMaxCameras> fingerprints_{};
  CameraSet known_;  // have a fingerprint
};

}  // namespace dottrack::core
