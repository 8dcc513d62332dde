#pragma once
// The gates that a region passes to be a dot candidate (paper sections 3.1.2, 3.3).

#include "app/core/image/components.h"
#include "app/core/image/identify.h"
#include "app/core/image/region.h"

namespace dottrack::image {

// The area and the bounding box alone rule the component out: whatever its moments, its area or
// its semi-major axis is outside the gate.
bool excludes_size(const RegionGate& gate, const Component& component);

bool passes_size(const RegionGate& gate, const Region& region);
bool passes_shape(const RegionGate& gate, const Region& region);

}  // namespace dottrack::image
