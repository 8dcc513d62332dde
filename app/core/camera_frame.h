#pragma once
// One camera's part in a tick, as the tracker core receives it.

#include "hal/base/image_view.h"
#include "hal/base/time.h"

namespace dottrack::core {

struct CameraFrame {
  bool delivered = false;
  ImageView image;  // of the camera's width and height, else it counts as not delivered
  Time mid_exposure{};
};

}  // namespace dottrack::core
