#pragma once
// What a camera is asked for, and from its regions to its lines of sight.

#include "app/core/acquisition/match.h"
#include "app/core/geometry/optics.h"
#include "app/core/image/identify.h"

namespace dottrack::acquisition {

// The 2-D gate of one camera's whole image, from its distance range and the target's dots (3.1.2).
image::RegionGate acquisition_gate(const core::Camera& camera, const geometry::Optics& optics,
                                   const core::Target& target);

// Fills the view's sightings with the regions that may be dots of the target: whole in the image,
// of a size that one has within the camera's distance limits. regions: null for no image.
void take_sightings(const core::Target& target, const geometry::Optics& optics,
                    const image::Regions* regions, CameraView& view);

}  // namespace dottrack::acquisition
