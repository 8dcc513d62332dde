#pragma once
// What the cameras show in the dots' places.

#include <Eigen/Core>
#include <array>

#include "app/core/dot_flaw.h"
#include "app/core/estimation/sighting.h"
#include "app/core/image/dot_fit.h"
#include "app/core/image/region.h"
#include "app/core/limits.h"
#include "hal/base/camera_set.h"

namespace dottrack::tracking {

struct SeenDot {
  bool any = false;
  bool bloomed = false;
  core::DotFlaw flaw = core::DotFlaw::none;
  image::Region region;  // chosen for the dot; its centroid is the dot's centre
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();  // of that centre
  image::DotLight light;
  estimation::Sighting sighting;
};

struct SeenDots {
  std::array<std::array<SeenDot, core::kMaxDots>, kMaxCameras> by_camera{};
  CameraSet distrusted;  // nothing rests on what these cameras show

  bool counts(std::size_t camera, std::size_t dot) const {
    return by_camera[camera][dot].any && !distrusted.contains(camera);
  }
};

}  // namespace dottrack::tracking
