#pragma once
// Which of the formats that a camera offers is taken.

#include <libcamera/camera.h>

#include <memory>
#include <string>
#include <vector>

#include "drivers/libcamera/picture.h"
#include "hal/base/result.h"

namespace dottrack::drivers {

struct ChosenFormat {
  std::unique_ptr<libcamera::CameraConfiguration> configuration;  // of one stream
  Packing packing = Packing::grey;

  // Once the camera is configured.
  Picture picture() const;
};

// The format that costs least and holds grey, at exactly this size: grey, planar, YUYV, MJPEG. An
// error lists what is offered.
Result<ChosenFormat> choose_format(libcamera::Camera& camera, int width_px, int height_px,
                                   unsigned buffers);

// "640x480 R8", of all formats that choose_format takes.
std::vector<std::string> offered_sizes(libcamera::Camera& camera);

}  // namespace dottrack::drivers
