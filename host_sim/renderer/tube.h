#pragma once
// A cable as the rays' tree holds it: a tube of flat faces just around it. The tree is half as deep
// as with round ones beside the meshes; where a ray meets the cable itself is worked out later.

#include <cstdint>

#include "host_sim/world/model.h"

namespace dottrack::host_sim {

inline constexpr std::uint32_t kTubeSides = 10;
inline constexpr std::uint32_t kTubeTriangles = 2 * kTubeSides;  // of one segment, in their order

// Of two points or more. The ends are open.
TriangleMesh tube_around(const Cable& cable);

}  // namespace dottrack::host_sim
