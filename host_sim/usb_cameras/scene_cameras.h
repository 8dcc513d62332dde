#pragma once
// The cameras of a scene as USB cameras.

#include <filesystem>

#include "hal/base/result.h"
#include "host_sim/scenarios/scene.h"
#include "host_sim/usb_cameras/usb_camera_bank.h"

namespace dottrack::host_sim {

// Names, size, rate and seed of the scene; exposure and gain of its first camera. An error when the
// cameras are not all of one size.
Result<UsbCameraSetup> setup_of(const Scene& scene, const std::filesystem::path& folder);

// Renders the hall: seconds. `scene` must outlive this and stay as it is. threads 0: as many as the
// machine has.
PictureSource pictures_of(const Scene& scene, unsigned threads = 0);

}  // namespace dottrack::host_sim
