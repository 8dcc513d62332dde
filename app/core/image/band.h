#pragma once
// The band of one camera's dots.

#include "app/core/image/identify.h"
#include "app/core/rig.h"

namespace dottrack::image {

inline Band band_of(const core::Camera& camera) {
  return {camera.intensity_min_dn, camera.intensity_max_dn, camera.min_contrast_dn,
          camera.background_px, camera.polarity};
}

}  // namespace dottrack::image
