#pragma once
// The band of one camera's dots.

#include <algorithm>
#include <cmath>

#include "app/core/image/identify.h"
#include "app/core/rig.h"

namespace dottrack::image {

inline Band band_of(const core::Camera& camera) {
  const int relative = static_cast<int>(std::lround(256.0 * camera.min_contrast_part));
  const int least_dn = std::max(camera.min_contrast_dn, relative > 0 ? 1 : 0);
  return {camera.intensity_min_dn, camera.intensity_max_dn, least_dn,
          camera.background_px,    camera.polarity,         relative};
}

}  // namespace dottrack::image
