#pragma once
// From one camera's regions to its lines of sight.

#include "app/core/acquisition/match.h"
#include "app/core/geometry/optics.h"
#include "app/core/image/identify.h"

namespace dottrack::acquisition {

// Fills the view's sightings with the regions that may be dots of the target: whole in the image,
// of a size that one has within the camera's distance limits. regions: null for no image.
void take_sightings(const core::Target& target, const geometry::Optics& optics,
                    const image::Regions* regions, CameraView& view);

}  // namespace dottrack::acquisition
