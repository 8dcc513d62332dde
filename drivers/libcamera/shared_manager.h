#pragma once
// libcamera allows one manager a process.

#include <libcamera/camera_manager.h>

#include <memory>

#include "hal/base/result.h"

namespace dottrack::drivers {

// Started; stops with its last user, who by then holds no camera. From any thread.
Result<std::shared_ptr<libcamera::CameraManager>> shared_manager();

}  // namespace dottrack::drivers
